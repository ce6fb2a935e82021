// Queries in batches: equal to brute force, ordered, and refused by name.
#include "compute/queries.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "compute/scene/shape_geometry.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

std::vector<RayQuery> rays(std::size_t count, float size, std::uint32_t seed) {
    tests::Noise noise(seed);
    std::vector<RayQuery> made;
    while (made.size() < count) {
        RayQuery ray;
        ray.from = noise.vector() * size + vec3(0, 1, 0);
        const vec3 along = noise.vector();
        if (glm::length(along) < 0.1f) continue;
        ray.along = glm::normalize(along);
        if (made.size() % 7 == 0) ray.along = {0, made.size() % 2 ? 1.0f : -1.0f, 0};  // along an axis
        if (made.size() % 5 == 0) ray.reach = 2 + noise();
        made.push_back(ray);
    }
    return made;
}

// All hits by a loop over everything.
std::vector<QueryHit> brute(const World& world, const std::vector<BodyState>& states, const RayQuery& ray) {
    std::vector<QueryHit> found;
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!states[i].exists) continue;
        const auto offer = [&](std::uint32_t part, const Shape& shape, vec3 position, vec4 orientation) {
            QueryHit hit{i, part, 0, {}, {}};
            if (ray.solid && contains(shape, position, orientation, ray.from)) return found.push_back(hit);
            const std::optional<float> at = ray_distance(shape, position, orientation, ray.from, ray.along);
            if (!at || *at > ray.reach) return;
            hit.distance = *at;
            found.push_back(hit);
        };
        const Shape& shape = world.scene().bodies[i].shape;
        if (const auto* compound = std::get_if<Compound>(&shape)) {
            const State& state = world.state();
            const std::size_t first = world.first_part_rows()[i];
            for (std::uint32_t k = 0; k < compound->parts.size(); ++k)
                offer(k, whole_shape(compound->parts[k].shape), state.poses[first + k].position,
                      state.poses[first + k].orientation);
        } else {
            offer(0, shape, states[i].position, states[i].orientation);
        }
    }
    std::sort(found.begin(), found.end(), [](const QueryHit& x, const QueryHit& y) {
        return std::tie(x.distance, x.body, x.part) < std::tie(y.distance, y.body, y.part);
    });
    return found;
}

}  // namespace

TEST_CASE("rays in batches equal brute force on every ray", "[world]") {
    World world(tests::museum(150), {}, 2), single(tests::museum(150), {}, 1);
    for (World* one : {&world, &single}) {
        one->step(50);
        one->remove_body(9);
        one->set_bodies(std::vector{BodyChange{4, vec3(0.5f, 3, 0.5f)}});
    }
    std::vector<RayQuery> queries = rays(4000, 14, 3);
    for (std::size_t i = 0; i < queries.size(); i += 3) queries[i].solid = false;
    const std::vector<BodyState> states = world.bodies();
    const auto nearest = world.cast_rays(queries), again = single.cast_rays(queries);
    const auto any = world.rays_hit(queries);
    const auto all = world.cast_rays_through(queries);
    std::size_t hits = 0, inside = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        INFO("ray " << i);
        const std::vector<QueryHit> expected = brute(world, states, queries[i]);
        REQUIRE(nearest[i].has_value() == !expected.empty());
        REQUIRE((any[i] == 1) == !expected.empty());
        REQUIRE(again[i].has_value() == nearest[i].has_value());
        if (expected.empty()) continue;
        ++hits;
        inside += expected[0].distance == 0;
        REQUIRE(nearest[i]->body == expected[0].body);
        REQUIRE(nearest[i]->distance == expected[0].distance);
        REQUIRE(nearest[i]->normal == again[i]->normal);
        REQUIRE(nearest[i]->point == again[i]->point);
        REQUIRE(std::abs(glm::length(nearest[i]->normal) - 1) < 1e-3f);
        REQUIRE(glm::dot(nearest[i]->normal, queries[i].along) < 1e-3f);
        // A mesh is met once here, triangle by triangle there.
        std::vector<std::pair<std::size_t, float>> bodies, expected_bodies;
        for (const QueryHit& hit : all[i])
            if (bodies.empty() || !std::holds_alternative<HeightField>(world.scene().bodies[hit.body].shape) ||
                bodies.back().first != hit.body)
                bodies.emplace_back(hit.body, hit.distance);
        for (const QueryHit& hit : expected) expected_bodies.emplace_back(hit.body, hit.distance);
        REQUIRE(bodies.size() >= expected_bodies.size());
        for (const auto& one : expected_bodies) REQUIRE(std::find(bodies.begin(), bodies.end(), one) != bodies.end());
        REQUIRE(std::is_sorted(all[i].begin(), all[i].end(),
                               [](const QueryHit& x, const QueryHit& y) { return x.distance < y.distance; }));
    }
    REQUIRE(hits > 1000);
    REQUIRE(inside > 20);
}

TEST_CASE("rays see the categories of their mask", "[world]") {
    Scene scene;
    for (int i = 0; i < 3; ++i) {
        Body body;
        body.position = {0, 0, -2.0f * static_cast<float>(i + 1)};
        body.motion = Motion::fixed;
        if (i < 2) body.filter = Filter{static_cast<std::uint32_t>(2 << i), 1, 0};
        scene.bodies.push_back(body);
    }
    World world(scene, {}, 1);
    const auto seen = [&](std::uint32_t mask) { return world.cast_rays(std::vector{RayQuery{.mask = mask}})[0]->body; };
    REQUIRE(seen(~0u) == 0);
    REQUIRE(seen(4) == 1);
    REQUIRE(seen(1) == 2);
    REQUIRE(world.cast_rays_through(std::vector{RayQuery{}, RayQuery{.mask = 8}, RayQuery{.mask = 3}}).starts ==
            std::vector<std::size_t>{0, 3, 3, 5});
}

TEST_CASE("overlaps find what a ray from the middle begins in, and what a ball touches", "[world]") {
    World world(tests::museum(150), {}, 2);
    world.step(60);
    tests::Noise noise(8);
    std::vector<ShapeOverlap> balls;
    std::vector<RayQuery> points;
    for (int i = 0; i < 2000; ++i) {
        const vec3 at = noise.vector() * vec3(13, 2, 6) + vec3(-6, 1.5f, 0);
        balls.push_back({Sphere{1e-3f}, at});
        balls.push_back({Sphere{0.3f}, at});
        balls.push_back({Box{vec3(0.2f, 0.3f, 0.1f)}, at, {noise(), noise(), noise(), 1.1f}});
        points.push_back({.from = at});
    }
    const auto found = world.overlaps(balls);
    const auto through = world.cast_rays_through(points);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const QueryHit& hit : through[i]) {
            if (hit.distance > 0) continue;
            ++inside;
            for (std::size_t k = 0; k < 3; ++k) {
                const auto list = found[3 * i + k];
                REQUIRE(std::find(list.begin(), list.end(), QueryPart{hit.body, hit.part}) != list.end());
            }
        }
        REQUIRE(found[3 * i + 1].size() >= found[3 * i].size());
    }
    REQUIRE(inside > 200);
    // A ball overlaps a ball by the distance of their centres.
    const std::vector<BodyState> states = world.bodies();
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t b = 0; b < states.size(); ++b) {
            const auto* sphere = std::get_if<Sphere>(&world.scene().bodies[b].shape);
            if (!sphere || !states[b].exists) continue;
            const float gap = glm::length(states[b].position - points[i].from) - sphere->radius - 0.3f;
            if (std::abs(gap) < 1e-4f) continue;
            const auto list = found[3 * i + 1];
            REQUIRE((std::find(list.begin(), list.end(), QueryPart{b, 0}) != list.end()) == (gap < 0));
        }
}

TEST_CASE("a cast shape stops where it touches, and before that overlaps nothing", "[world]") {
    World world(tests::museum(150), {}, 2);
    world.step(60);
    tests::Noise noise(9);
    std::vector<ShapeCast> casts;
    for (int i = 0; i < 600; ++i) {
        ShapeCast cast;
        if (i % 3 == 0) cast.shape = Sphere{0.2f};
        if (i % 3 == 1) cast.shape = Box{vec3(0.2f, 0.1f, 0.3f)};
        if (i % 3 == 2) cast.shape = Cylinder{0.2f, 0.3f};
        cast.orientation = {noise(), noise(), noise(), 1.2f};
        cast.from = noise.vector() * vec3(12, 1, 6) + vec3(-5, 7, 0);
        cast.along = glm::normalize(vec3{0.4f * noise(), -1, 0.4f * noise()});
        cast.reach = 20;
        casts.push_back(cast);
    }
    const auto hits = world.cast_shapes(casts);
    std::size_t met = 0;
    for (std::size_t i = 0; i < casts.size(); ++i) {
        INFO("cast " << i);
        REQUIRE(hits[i].has_value());  // there is the ground
        const float at = hits[i]->distance;
        if (at == 0) continue;
        ++met;
        std::vector<ShapeOverlap> along;
        for (const float back : {0.5f, 0.1f, 0.01f, 0.001f})
            if (at > back) along.push_back({casts[i].shape, casts[i].from + casts[i].along * (at - back), casts[i].orientation});
        for (std::size_t k = 0; k < along.size(); ++k) REQUIRE(world.overlaps(along)[k].empty());
        const ShapeOverlap further{casts[i].shape, casts[i].from + casts[i].along * (at + 2e-3f), casts[i].orientation};
        const auto touched = world.overlaps({&further, 1});
        const QueryPart part{hits[i]->body, hits[i]->part};
        const bool grazing = std::abs(glm::dot(hits[i]->normal, casts[i].along)) < 0.2f;
        REQUIRE((grazing || std::find(touched[0].begin(), touched[0].end(), part) != touched[0].end()));
    }
    REQUIRE(met > 400);
    // A ball falls on the ground by closed form.
    const ShapeCast fall{.shape = Sphere{0.5f}, .from = {200, 10, 0}, .along = {0, -1, 0}, .reach = 20};
    REQUIRE(world.cast_shapes({&fall, 1})[0]->distance == Approx(9.5f).margin(2e-4));
    const ShapeCast near{.shape = Sphere{0.5f}, .from = {200, 10, 0}, .along = {0, -1, 0}, .reach = 9};
    REQUIRE(!world.cast_shapes({&near, 1})[0]);
}

TEST_CASE("queries that mean nothing are refused by name", "[world]") {
    World world(tests::heap(5), {}, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    REQUIRE_THROWS_WITH(world.cast_rays(std::vector{RayQuery{}, RayQuery{.along = vec3(0)}}), Catch::Contains("ray 1"));
    REQUIRE_THROWS_WITH(world.cast_rays(std::vector{RayQuery{.from = vec3(nan)}}), Catch::Contains("ray 0"));
    REQUIRE_THROWS_WITH(world.rays_hit(std::vector{RayQuery{.reach = 0}}), Catch::Contains("reach"));
    REQUIRE_THROWS_WITH(world.cast_shapes(std::vector{ShapeCast{.shape = Plane{}}}), Catch::Contains("cast 0"));
    REQUIRE_THROWS_WITH(world.cast_shapes(std::vector{ShapeCast{.reach = nan}}), Catch::Contains("reach"));
    REQUIRE_THROWS_WITH(world.overlaps(std::vector{ShapeOverlap{.shape = Sphere{-1}}}), Catch::Contains("radius"));
    REQUIRE_THROWS_WITH(world.overlaps(std::vector{ShapeOverlap{.orientation = vec4(0)}}), Catch::Contains("orientation"));
    REQUIRE(world.cast_rays({}).empty());
    REQUIRE(World{Scene{}}.cast_rays(std::vector{RayQuery{}})[0].has_value() == false);
}
