// Invariants of manifolds at random poses: finite numbers, unit normals, points between the surfaces, frame
// independence.
#include <catch2/catch.hpp>

#include "tests/physics/collide_cases.h"

namespace {

using namespace scree::tests;
namespace physics = scree::physics;

constexpr float margin = 0.05f;  // m

struct Case {
    BodyProperties a, b;
    Pose pose_a, pose_b;
};
Case random_case(Chance& chance, const ShapePair& pair) {
    Case c;
    c.a = chance.body(pair.a);
    c.b = chance.body(pair.b);
    c.pose_a = Pose{chance.point_within(3), 0, chance.orientation()};
    c.pose_b = Pose{c.pose_a.position + chance.point_within(2.2f), 0, chance.orientation()};
    return c;
}

bool is_sound(const ManifoldBuffer& touch, float within) {
    if (touch.count > 4u) return false;
    for (uint k = 0; k < 4; ++k) {
        const vec4 p = touch.manifold.points[k];
        if (!std::isfinite(p.x + p.y + p.z + p.w)) return false;
        if (k >= touch.count && p != vec4(0)) return false;
        if (k < touch.count && p.w >= within) return false;
    }
    return touch.count == 0u || std::abs(glm::length(touch.manifold.normal) - 1.0f) < 1e-5f;
}

}  // namespace

TEST_CASE("random poses give finite points and unit normals", "[collide]") {
    for (const ShapePair& pair : all_pairs()) {
        Chance chance(31);
        int touching = 0;
        for (int k = 0; k < 5000; ++k) {
            const Case c = random_case(chance, pair);
            const ManifoldBuffer touch = collide(c.a, c.pose_a, c.b, c.pose_b, margin);
            touching += touch.count > 0u ? 1 : 0;
            if (!is_sound(touch, margin)) FAIL(pair.name << ", case " << k);
        }
        INFO(pair.name);
        CHECK(touching > 500);
    }
}

TEST_CASE("poses on a lattice, where axes are parallel and features coincide, give finite points and unit normals", "[collide]") {
    const std::vector<BodyProperties> bodies = {sphere(0.5f), capsule(0.5f, 0.5f), capsule(0.25f, 0.0f), box(0.5f, 0.5f, 0.5f),
                                                box(1, 0.5f, 0.25f)};
    const BodyProperties ground = plane(vec3(0, 1, 0));
    std::vector<vec4> orientations;
    for (int k = 0; k < 4; ++k) {
        for (const vec3 axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 1, 0)}) {
            orientations.push_back(turn(axis, 0.78539816f * float(k)));
        }
    }
    int cases = 0;
    for (const BodyProperties& a : bodies) {
        for (const vec4& turn_a : orientations) {
            for (int x = -4; x <= 4; ++x) {
                const Pose pose_a = at(0.25f * float(x), 0.5f, 0, turn_a);
                REQUIRE(is_sound(collide(a, pose_a, ground, at(0, 0, 0), margin), margin));
                for (const BodyProperties& b : bodies) {
                    if (b.shape < a.shape) continue;
                    for (const vec4& turn_b : orientations) {
                        for (const float y : {0.5f, 0.75f, 1.0f, 1.5f}) {
                            if (!is_sound(collide(a, pose_a, b, at(0, y, 0.5f, turn_b), margin), margin)) FAIL("case " << cases);
                            ++cases;
                        }
                    }
                }
            }
        }
    }
    CHECK(cases > 50000);
}

TEST_CASE("tiny, large and thin bodies give finite points and unit normals", "[collide]") {
    for (const ShapePair& pair : all_pairs()) {
        Chance chance(37);
        for (int k = 0; k < 3000; ++k) {
            Case c = random_case(chance, pair);
            for (BodyProperties* body : {&c.a, &c.b}) {
                if (body->shape == physics::SHAPE_PLANE) continue;
                const float scale = std::pow(10.0f, chance.between(-3, 3));
                body->size *= vec3(scale, scale * std::pow(10.0f, chance.between(-2, 2)), scale);
            }
            const float size = glm::length(c.a.size) + (pair.b == physics::SHAPE_PLANE ? 0.0f : glm::length(c.b.size));
            c.pose_b.position = c.pose_a.position + chance.point_within(size);
            if (!is_sound(collide(c.a, c.pose_a, c.b, c.pose_b, margin), margin)) FAIL(pair.name << ", case " << k);
        }
    }
}

TEST_CASE("a point lies midway between the two surfaces", "[collide]") {
    for (const ShapePair& pair : all_pairs()) {
        Chance chance(41);
        int points = 0, outside = 0;
        for (int k = 0; k < 5000; ++k) {
            const Case c = random_case(chance, pair);
            const ManifoldBuffer touch = collide(c.a, c.pose_a, c.b, c.pose_b, margin);
            for (uint j = 0; j < touch.count; ++j) {
                const glm::dvec3 p(touch.manifold.points[j]);
                const double half = 0.5 * std::abs(touch.manifold.points[j].w);
                const double from_a = signed_distance(c.a, c.pose_a, p);
                const double from_b = signed_distance(c.b, c.pose_b, p - glm::dvec3(c.pose_b.position - c.pose_a.position));
                ++points;
                // At the ends of nearly parallel capsules the gap is told too small by up to a 50th of their radii (by more at 12
                // of 3.6 million points).
                const bool ends = pair.b == physics::SHAPE_CAPSULE && touch.count == 2 && c.a.shape == physics::SHAPE_CAPSULE;
                const double within = 6e-4 + (ends ? (c.a.size.x + c.b.size.x) / 50 : 0.0f);
                const bool beyond = from_a > half + within || from_b > half + within;
                // The second point of a tilted capsule is below its surface.
                const bool below_a = from_a < -half - 6e-4 && c.a.shape != physics::SHAPE_CAPSULE;
                const bool below_b = from_b < -half - 6e-4 && c.b.shape != physics::SHAPE_CAPSULE;
                if (beyond || below_a || below_b) ++outside;
            }
        }
        INFO(pair.name << ": " << outside << " of " << points);
        CHECK(points > 500);
        // Between crossing box edges a point may be on neither surface.
        CHECK(outside <= (pair.b == physics::SHAPE_BOX ? points / 100 : 0));
    }
}

TEST_CASE("a body and its mirror role feel the same touch", "[collide]") {
    using namespace physics;
    for (const uint shape : {SHAPE_SPHERE, SHAPE_CAPSULE, SHAPE_BOX}) {
        Chance chance(43);
        int touching = 0, unlike = 0;
        for (int k = 0; k < 5000; ++k) {
            const Case c = random_case(chance, {shape, shape, ""});
            const ManifoldBuffer one = collide(c.a, c.pose_a, c.b, c.pose_b, margin);
            const ManifoldBuffer other =
                flipped(collide(c.b, c.pose_b, c.a, c.pose_a, margin), c.pose_a.position - c.pose_b.position);
            if (one.count == 0 && other.count == 0) continue;
            ++touching;
            const bool alike = one.count == other.count && std::abs(deepest_of(one) - deepest_of(other)) < 2e-5f &&
                               glm::length(one.manifold.normal - other.manifold.normal) < 1e-3f;
            // Boxes prefer faces of the first body by 0.5 mm, and faces to edges by 5 mm.
            REQUIRE(std::abs(deepest_of(one) - deepest_of(other)) < 6e-3f);
            if (!alike) ++unlike;
        }
        INFO(unlike << " of " << touching);
        CHECK(touching > 500);
        CHECK(unlike <= (shape == SHAPE_SPHERE ? 0 : touching / 50));
    }
}

TEST_CASE("turning and shifting both bodies turns their touch", "[collide]") {
    for (const ShapePair& pair : all_pairs()) {
        Chance chance(47);
        int touching = 0, unlike = 0;
        for (int k = 0; k < 5000; ++k) {
            const Case c = random_case(chance, pair);
            const vec4 q = chance.orientation();
            const vec3 shift = chance.direction();
            const auto moved = [&](const Pose& pose) {
                return Pose{shift + physics::rotate(q, pose.position), 0,
                            physics::unit_quaternion(physics::compose(q, pose.orientation))};
            };
            BodyProperties b = c.b;
            if (b.shape == physics::SHAPE_PLANE) b.size = physics::rotate(q, b.size);
            const ManifoldBuffer one = collide(c.a, c.pose_a, c.b, c.pose_b, margin);
            const ManifoldBuffer other = collide(c.a, moved(c.pose_a), b, moved(c.pose_b), margin);
            if (one.count == 0 && other.count == 0) continue;
            ++touching;
            bool alike = one.count == other.count && std::abs(deepest_of(one) - deepest_of(other)) < 2e-5f &&
                         glm::length(physics::rotate(q, one.manifold.normal) - other.manifold.normal) < 1e-3f;
            for (uint j = 0; alike && j < one.count; ++j) {
                alike = glm::length(physics::rotate(q, point_of(one, j)) - point_of(other, j)) < 1e-3f;
            }
            if (!alike) ++unlike;
        }
        INFO(pair.name << ": " << unlike << " of " << touching);
        CHECK(touching > 500);
        // Between equally good answers rounding decides.
        CHECK(unlike <= touching / 200);
    }
}
