// The nearest point of bodies, against every body alone and closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("the closest points of simple bodies are where geometry says") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{vec3(1)}, .position = {0, 5, 0}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Sphere{1}, .position = {10, 5, 0}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Sphere{3}, .role = Role::sensor, .position = {0, 9, 0}});
    World world(scene);
    const std::vector<ClosestQuery> points{{.point = {0.5f, 8, 0.2f}, .reach = 5}, {.point = {3, 7, 1}, .reach = 5},
                                           {.point = {10, 8, 0}, .reach = 5},      {.point = {5, 2, 0}, .reach = 5},
                                           {.point = {0, 5.2f, 0}, .reach = 5},    {.point = {5, 40, 0}, .reach = 5}};
    const auto found = world.closest_points(points);
    CHECK(found[0]->body == 1);
    CHECK(found[0]->distance == Approx(2));
    CHECK(glm::length(found[0]->point - vec3(0.5f, 6, 0.2f)) < 1e-5f);
    CHECK(found[1]->distance == Approx(std::sqrt(5.0f)));
    CHECK(glm::length(found[1]->point - vec3(1, 6, 1)) < 1e-5f);
    CHECK(found[2]->body == 2);
    CHECK(glm::length(found[2]->normal - vec3(0, 1, 0)) < 1e-5f);
    CHECK(found[3]->body == 0);
    CHECK(found[3]->point.y == Approx(0).margin(1e-5));
    CHECK(found[4]->body == 1);
    CHECK(found[4]->distance == 0);
    CHECK_FALSE(found[5]);
    CHECK_THROWS_WITH(world.closest_points(std::vector{ClosestQuery{.point = vec3(NAN)}}),
                      Catch::Contains("point 0: it must be finite"));
    CHECK_THROWS_WITH(world.closest_points(std::vector{ClosestQuery{}, ClosestQuery{.reach = 0}}),
                      Catch::Contains("point 1: its reach"));
    CHECK_THROWS_WITH(world.closest_points(std::vector{ClosestQuery{.reach = NAN}}), Catch::Contains("point 0: its reach"));
}

TEST_CASE("rays, casts and closest points take infinity and unlimited for no limit, and find what is far away") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{vec3(100)}, .position = {9e5f, 0, 0}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{vec3(100)}, .position = {-9.5e5f, 0, 0}});
    World world(scene);
    const vec3 from(-9e5f, 0, 0), right(1, 0, 0);
    for (const float reach : {unlimited, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::max(), 2e6f}) {
        CAPTURE(reach);
        const auto ray = world.cast_rays(std::vector{RayQuery{.from = from, .along = right, .reach = reach}});
        const auto cast =
            world.cast_shapes(std::vector{ShapeCast{.shape = Sphere{50}, .from = from, .along = right, .reach = reach}});
        REQUIRE((ray[0] && cast[0]));
        CHECK(ray[0]->distance == Approx(1.7999e6));
        CHECK(cast[0]->distance == Approx(1.79985e6));
        CHECK(cast[0]->body == 0);
        const auto near = world.closest_points(std::vector{ClosestQuery{.point = {2.5e6f, 0, 0}, .reach = reach},
                                                           ClosestQuery{.point = from, .reach = reach},
                                                           ClosestQuery{.point = from, .reach = reach, .mask = 2}});
        REQUIRE((near[0] && near[1]));
        CHECK(near[0]->body == 0);
        CHECK(near[0]->distance == Approx(1.5999e6));
        CHECK(near[1]->body == 1);
        CHECK(near[1]->distance == Approx(4.99e4));
        CHECK_FALSE(near[2]);
    }
    for (const float reach : {1e-3f, 1e-44f})
        CHECK_FALSE(world.closest_points(std::vector{ClosestQuery{.point = from, .reach = reach}})[0]);
}

TEST_CASE("of many bodies the closest point is that of the nearest one, with any number of threads") {
    const Scene scene = tests::heap(150);
    World world(scene, {}, 1), other(scene, {}, 2);
    world.step(60), other.step(60);
    const Scene now = world.snapshot();
    std::vector<World> alone;
    for (const Body& body : now.bodies) alone.emplace_back(Scene{vec3(0), {body}, {}}, Settings{}, 1);
    tests::Noise noise(3);
    std::vector<ClosestQuery> points;
    for (int i = 0; i < 200; ++i) points.push_back({.point = noise.vector() * vec3(4, 3, 4) + vec3(0, 2, 0), .reach = 2.5f});
    const auto found = world.closest_points(points), again = other.closest_points(points);
    std::vector<std::optional<QueryHit>> expected(points.size());
    for (std::size_t b = 0; b < alone.size(); ++b) {
        const auto mine = alone[b].closest_points(points);
        for (std::size_t i = 0; i < points.size(); ++i)
            if (mine[i] && (!expected[i] || mine[i]->distance < expected[i]->distance)) {
                expected[i] = mine[i];
                expected[i]->body = b;
            }
    }
    std::size_t hits = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        REQUIRE(found[i].has_value() == expected[i].has_value());
        if (!found[i]) continue;
        ++hits;
        CHECK(found[i]->body == expected[i]->body);
        CHECK(found[i]->distance == Approx(expected[i]->distance).margin(1e-5));
        CHECK(
            (again[i]->body == found[i]->body && again[i]->distance == found[i]->distance && again[i]->point == found[i]->point));
    }
    CHECK(hits > 100);
}
