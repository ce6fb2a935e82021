// Ray casts: body, point and normal of the hit.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "compute/world.h"

using namespace scree;

namespace {

void require_near(vec3 a, vec3 b) {
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    REQUIRE(glm::length(a - b) < 1e-4f);
}

std::size_t add(Scene& scene, Shape shape, vec3 position, vec4 orientation = {0, 0, 0, 1}) {
    Body body;
    if (std::holds_alternative<Plane>(shape) || std::holds_alternative<Mesh>(shape)) body.motion = Motion::fixed;
    body.shape = std::move(shape);
    body.position = position;
    body.orientation = orientation;
    scene.bodies.push_back(body);
    return scene.bodies.size() - 1;
}

}  // namespace

TEST_CASE("a ray meets the nearest body, at its surface, with the normal there") {
    Scene scene;
    add(scene, Plane{}, vec3(0));
    const std::size_t sphere = add(scene, Sphere{1}, {0, 5, 0}), box = add(scene, Box{vec3(1, 0.5f, 1)}, {4, 5, 0});
    const World world(scene, {}, 1);
    const std::optional<RayHit> down = world.cast_ray({{0.6f, 20, 0}, {0, -1, 0}});
    REQUIRE(down);
    CHECK(down->body == sphere);
    CHECK(down->distance == Approx(14.2));
    require_near(down->point, {0.6f, 5.8f, 0});
    require_near(down->normal, {0.6f, 0.8f, 0});
    const std::optional<RayHit> side = world.cast_ray({{20, 5, 0}, {-1, 0, 0}});
    REQUIRE(side->body == box);
    require_near(side->normal, {1, 0, 0});
    const std::optional<RayHit> beside = world.cast_ray({{9, 20, 0}, {0, -1, 0}});
    REQUIRE(beside->body == 0);
    require_near(beside->normal, {0, 1, 0});
    CHECK_FALSE(world.cast_ray({{9, 20, 0}, {0, 1, 0}}));
    CHECK_THROWS_AS(world.cast_ray({{9, 20, 0}, {0, 2, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(world.cast_ray({{9, std::numeric_limits<float>::quiet_NaN(), 0}, {0, 1, 0}}), std::invalid_argument);
}

TEST_CASE("the normal where a ray meets a shape is that of the surface, however the body lies") {
    const float half = std::sqrt(0.5f);
    const vec4 lying(0, 0, half, half);  // a quarter turn about z: the body's y is the world's -x
    const auto normal_of = [](Shape shape, vec4 orientation, Ray ray) {
        Scene scene;
        add(scene, std::move(shape), vec3(0), orientation);
        const World world(scene, {}, 1);
        const std::optional<RayHit> hit = world.cast_ray(ray);
        REQUIRE(hit);
        return hit->normal;
    };
    const Ray down{{0.1f, 5, 0.05f}, {0, -1, 0}}, across{{-5, 0.1f, 0}, {1, 0, 0}};
    require_near(normal_of(Cylinder{0.5f, 1}, {0, 0, 0, 1}, down), {0, 1, 0});
    require_near(normal_of(Cylinder{0.5f, 1}, {0, 0, 0, 1}, across), {-1, 0, 0});
    require_near(normal_of(Cylinder{0.5f, 1}, lying, across), {-1, 0, 0});
    require_near(normal_of(Capsule{0.5f, 1}, {0, 0, 0, 1}, across), {-1, 0, 0});
    require_near(normal_of(Cone{0.5f, 1}, {0, 0, 0, 1}, across), glm::normalize(vec3(-1, 0.5f, 0)));
    require_near(normal_of(Cone{0.5f, 1}, {0, 0, 0, 1}, {{0.1f, -5, 0}, {0, 1, 0}}), {0, -1, 0});
    Hull cube;
    for (int k = 0; k < 8; ++k) cube.points.emplace_back(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    require_near(normal_of(cube, lying, across), {-1, 0, 0});
    Compound two;
    two.parts.push_back({.shape = Box{vec3(1, 0.5f, 1)}});
    two.parts.push_back({.shape = Sphere{0.5f}, .position = {0, 3, 0}});
    two.parts.push_back({.shape = Sphere{0.5f}, .position = {0, -3, 0}});
    require_near(normal_of(two, {0, 0, 0, 1}, {{0.9f, 5, 0}, {0, -1, 0}}), {0, 1, 0});
    Mesh ridge;
    ridge.vertices = {{-1, 0, -9}, {-1, 0, 9}, {0, 1, -9}, {0, 1, 9}, {1, 0, -9}, {1, 0, 9}};
    ridge.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
    Scene scene;
    add(scene, ridge, vec3(0));
    const World world(scene, {}, 1);
    require_near(world.cast_ray({{-0.5f, 5, 0.3f}, {0, -1, 0}})->normal, glm::normalize(vec3(-1, 1, 0)));
    require_near(world.cast_ray({{0.5f, 5, 0.3f}, {0, -1, 0}})->normal, glm::normalize(vec3(1, 1, 0)));
}
