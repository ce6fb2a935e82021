// Distances of cylinders, cones, hulls and ellipsoids to all shapes, against an independent search over directions.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "compute/scene/meshes/hull.h"
#include "compute/tables/state.h"
#include "shaders/physics/collide/collide_convex.h"
#include "tests/physics/chance.h"

using namespace scree;
using glm::dvec3;
using tests::any_turn;
using tests::between;

namespace {

using Chance = std::mt19937;

Shape any_shape(std::size_t kind, Chance& chance) {
    if (kind == 0) return Sphere{between(chance, 0.2f, 0.6f)};
    if (kind == 1) return Capsule{between(chance, 0.1f, 0.4f), between(chance, 0.1f, 0.6f)};
    if (kind == 2) return Box{{between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f)}};
    if (kind == 4) return Cylinder{between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f)};
    if (kind == 5) return Cone{between(chance, 0.3f, 0.6f), between(chance, 0.5f, 1.2f)};
    if (kind == 7) return Ellipsoid{{between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f), between(chance, 0.2f, 0.6f)}};
    Hull hull;
    for (int k = 0; k < 14; ++k)
        hull.points.push_back({between(chance, -0.6f, 0.6f), between(chance, -0.6f, 0.6f), between(chance, -0.6f, 0.6f)});
    return hull;
}

// Support of a body along a unit direction from its centre, m.
double reach(const Body& body, dvec3 direction) {
    const glm::dquat q(body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z);
    const dvec3 d = glm::conjugate(q) * direction;
    const double across = std::sqrt(d.x * d.x + d.z * d.z);
    if (const auto* s = std::get_if<Sphere>(&body.shape)) return s->radius;
    if (const auto* c = std::get_if<Capsule>(&body.shape)) return c->radius + c->half_height * std::abs(d.y);
    if (const auto* b = std::get_if<Box>(&body.shape)) return glm::dot(glm::abs(d), dvec3(b->half_extents));
    if (const auto* c = std::get_if<Cylinder>(&body.shape)) return c->radius * across + c->half_height * std::abs(d.y);
    if (const auto* c = std::get_if<Cone>(&body.shape))
        return std::max(0.75 * c->height * d.y, c->radius * across - 0.25 * c->height * d.y);
    if (const auto* e = std::get_if<Ellipsoid>(&body.shape)) return glm::length(d * dvec3(e->radii));
    double most = -1e300;
    for (const vec3& point : std::get<Hull>(body.shape).points) most = std::max(most, glm::dot(dvec3(point), d));
    return most;
}
double separation(const Body& a, const Body& b, dvec3 n) {
    return glm::dot(n, dvec3(b.position) - dvec3(a.position)) - reach(a, n) - reach(b, -n);
}

// The largest separation over all directions: sampling, then hill climbing from the best samples.
double largest_separation(const Body& a, const Body& b) {
    std::array<std::pair<double, dvec3>, 6> best;
    best.fill({-1e300, dvec3(0)});
    constexpr int directions = 1500;
    for (int k = 0; k < directions; ++k) {
        const double y = 1 - (2 * k + 1.0) / directions, angle = 2.399963229728653 * k, r = std::sqrt(1 - y * y);
        const dvec3 n(r * std::cos(angle), y, r * std::sin(angle));
        const double s = separation(a, b, n);
        if (s > best.back().first) best.back() = {s, n};
        std::sort(best.begin(), best.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
    }
    for (auto& [s, n] : best) {
        for (double step = 0.06; step > 1e-7;) {
            bool climbed = false;
            const dvec3 u = glm::normalize(glm::cross(n, std::abs(n.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
            const dvec3 v = glm::cross(n, u);
            for (int k = 0; k < 12; ++k) {
                const dvec3 m = glm::normalize(n + (u * std::cos(k * 0.5236) + v * std::sin(k * 0.5236)) * step);
                const double t = separation(a, b, m);
                if (t > s) s = t, n = m, climbed = true;
            }
            if (!climbed) step *= 0.5;
        }
    }
    double most = best[0].first;
    for (const auto& [s, n] : best) most = std::max(most, s);
    return most;
}

struct Pair {
    Body a, b;
    State state;
    Pair(const Scene& scene) : a(scene.bodies[0]), b(scene.bodies[1]), state(scene, {}, 128, true) {}
};
Pair any_pair(std::size_t kind_a, std::size_t kind_b, Chance& chance) {
    Scene scene;
    scene.bodies.resize(2);
    scene.bodies[0].shape = any_shape(kind_a, chance);
    scene.bodies[1].shape = any_shape(kind_b, chance);
    for (Body& body : scene.bodies) body.orientation = any_turn(chance);
    scene = checked(scene);
    const dvec3 way = glm::normalize(dvec3{between(chance, -1, 1), between(chance, -1, 1), between(chance, -1, 1.01f)});
    // Distance at which the supports along the line of centres leave a gap or overlap.
    const double apart = reach(scene.bodies[0], way) + reach(scene.bodies[1], -way) - between(chance, -0.1f, 0.15f);
    scene.bodies[0].position = vec3(0.3f, -0.2f, 0.1f);
    scene.bodies[1].position = scene.bodies[0].position + vec3(way * apart);
    return Pair(scene);
}

constexpr std::array<std::pair<std::size_t, std::size_t>, 22> kinds{
    {{0, 4}, {0, 5}, {0, 6}, {1, 4}, {1, 5}, {1, 6}, {2, 4}, {2, 5}, {2, 6}, {4, 4}, {4, 5},
     {4, 6}, {5, 5}, {5, 6}, {6, 6}, {0, 7}, {1, 7}, {2, 7}, {4, 7}, {5, 7}, {7, 6}, {7, 7}}};

}  // namespace

TEST_CASE("the separation of convex bodies is that of the best of all directions") {
    Chance chance(11);
    for (const auto& [kind_a, kind_b] : kinds) {
        CAPTURE(kind_a, kind_b);
        int off = 0;
        for (int k = 0; k < 40; ++k) {
            const Pair pair = any_pair(kind_a, kind_b, chance);
            const physics::ConvexShape a =
                physics::convex_shape_of(pair.state.properties[0], pair.a.orientation, pair.state.hull_table());
            const physics::ConvexShape b =
                physics::convex_shape_of(pair.state.properties[1], pair.b.orientation, pair.state.hull_table());
            const physics::Separation s =
                physics::separation_of(a, b, pair.b.position - pair.a.position, 1e30f, pair.state.hull_table());
            const double truth = std::max(largest_separation(pair.a, pair.b), separation(pair.a, pair.b, dvec3(s.normal)));
            INFO("pose " << k << ": " << s.distance << " of " << truth);
            // The separation along a direction, hence at most the true distance.
            REQUIRE(s.distance <= separation(pair.a, pair.b, dvec3(s.normal)) + 2e-5);
            REQUIRE(s.distance < truth + 1e-4);
            if (truth > 0) REQUIRE(s.distance > truth - 1e-3);
            off += s.distance < truth - 2e-3;
        }
        // For overlapping bodies the minimal translation may be missed for one almost as short.
        CHECK(off <= 2);
    }
}

TEST_CASE("points of convex bodies lie between their surfaces, as deep as the normal says") {
    Chance chance(12);
    for (const auto& [kind_a, kind_b] : kinds) {
        CAPTURE(kind_a, kind_b);
        int touching = 0, shallow = 0;
        for (int k = 0; k < 60; ++k) {
            const Pair pair = any_pair(kind_a, kind_b, chance);
            const physics::ManifoldBuffer touch =
                physics::collide_convex(pair.state.properties[0], pair.state.poses[0], pair.state.properties[1],
                                        pair.state.poses[1], 0.02f, pair.state.hull_table());
            const double truth = largest_separation(pair.a, pair.b);
            INFO("pose " << k << ": truth " << truth << ", points " << touch.count);
            if (truth > 0.025) REQUIRE(touch.count == 0);
            if (truth < 0.015) REQUIRE(touch.count > 0);
            if (touch.count == 0) continue;
            ++touching;
            const dvec3 n(touch.manifold.normal);
            REQUIRE(std::abs(glm::length(n) - 1) < 1e-5);
            for (physics::uint p = 0; p < touch.count; ++p) {
                const vec4 point = touch.manifold.points[p];
                const double half = 0.5 * static_cast<double>(point.w);
                REQUIRE(glm::dot(n, dvec3(point)) <= reach(pair.a, n) + half + 2e-4);
                const dvec3 from_b = dvec3(point) - dvec3(pair.b.position - pair.a.position);
                REQUIRE(glm::dot(-n, from_b) <= reach(pair.b, -n) + half + 2e-4);
            }
            shallow += std::abs(static_cast<double>(physics::deepest_of(touch)) - separation(pair.a, pair.b, n)) > 0.01;
        }
        REQUIRE(touching > 10);
        CHECK(shallow <= touching / 10);
    }
}

TEST_CASE("bodies that stand on a plane have points under their whole base") {
    Scene scene;
    const Shape shapes[] = {Cylinder{0.3f, 0.4f}, Cone{0.3f, 0.8f},
                            Hull{{{-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}, {0, 1, 0}}, {}}};
    const float bases[] = {0.4f, 0.2f, 0.5f};
    for (const Shape& shape : shapes) scene.bodies.emplace_back().shape = shape;
    const State state(checked(scene), {}, 128, true);
    physics::BodyProperties plane{};
    plane.shape = physics::SHAPE_PLANE;
    plane.size = vec3(0, 1, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        CAPTURE(i);
        physics::Pose pose = state.poses[i];
        pose.position = vec3(3, bases[i] - 0.001f, 1);
        const physics::ManifoldBuffer touch = physics::collide_plane_convex(plane, physics::Pose{vec3(0), 0, vec4(0, 0, 0, 1)},
                                                                            state.properties[i], pose, 0.01f, state.hull_table());
        REQUIRE(touch.count == 4);
        vec3 low(1e9f), high(-1e9f);
        for (const vec4& point : touch.manifold.points) {
            REQUIRE(point.w == Approx(-0.001f).margin(1e-5));
            low = glm::min(low, vec3(point));
            high = glm::max(high, vec3(point));
        }
        REQUIRE((low.x + high.x) / 2 == Approx(3).margin(1e-4));
        REQUIRE(high.x - low.x > (i == 2 ? 1.99f : 0.59f));
        REQUIRE(high.z - low.z > (i == 2 ? 1.99f : 0.59f));
    }
}
