// Ellipsoids in the world, against closed forms: mass, rest, rocking, rolling, tumbling, rays, scene files.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;
using tests::ground;

namespace {

constexpr float g = 9.81f;

Body body_of(Shape shape, vec3 position, vec4 orientation = {0, 0, 0, 1}) {
    Body body;
    body.shape = std::move(shape);
    body.position = position;
    body.orientation = orientation;
    return body;
}
glm::quat turn_of(const BodyState& state) {
    return {state.orientation.w, state.orientation.x, state.orientation.y, state.orientation.z};
}
vec3 angular_momentum(const BodyState& state, const MassProperties& mass) {
    return turn_of(state) * (mass.inertia * (glm::conjugate(turn_of(state)) * state.angular_velocity));
}

}  // namespace

TEST_CASE("an ellipsoid has the mass and inertia of the textbook, and with equal radii those of a sphere") {
    const MassProperties mass = mass_properties(Ellipsoid{{0.5f, 0.3f, 0.4f}}, 1000);
    CHECK(mass.mass == Approx(251.32741));
    CHECK(mass.inertia.x == Approx(251.32741 / 5 * (0.09 + 0.16)));
    CHECK(mass.inertia.y == Approx(251.32741 / 5 * (0.25 + 0.16)));
    CHECK(mass.inertia.z == Approx(251.32741 / 5 * (0.25 + 0.09)));
    const MassProperties even = mass_properties(Ellipsoid{vec3(0.4f)}, 700), sphere = mass_properties(Sphere{0.4f}, 700);
    CHECK(even.mass == Approx(sphere.mass));
    CHECK(even.inertia.y == Approx(sphere.inertia.y));
}

TEST_CASE("an ellipsoid rests at the height of its smallest radius, wherever it points") {
    Scene scene;
    scene.bodies = {ground(), body_of(Ellipsoid{{0.5f, 0.2f, 0.4f}}, {0, 0.2f, 0}),
                    body_of(Ellipsoid{{0.2f, 0.5f, 0.3f}}, {3, 0.2f, 0}, {0, 0, std::sqrt(0.5f), std::sqrt(0.5f)})};
    Body tipped = body_of(Ellipsoid{{0.5f, 0.3f, 0.4f}}, {6, 0.6f, 0}, {0.3f, 0.1f, 0.2f, 0.9f});
    tipped.rolling_resistance = 0.01f;
    scene.bodies.push_back(tipped);
    World world(scene, {}, 1);
    world.step(1200);
    const float heights[] = {0.2f, 0.2f, 0.3f};
    for (std::size_t i = 1; i <= 3; ++i) {
        const BodyState body = world.body(i);
        CAPTURE(i, body.position.y);
        CHECK(body.position.y == Approx(heights[i - 1]).margin(2e-3));
        CHECK(glm::length(body.velocity) < 1e-3f);
    }
}

// Small oscillations of a rolling ellipsoid: V = m g h, h = b + (a^2 - b^2) / (2 b) angle^2, T = (I + m b^2) spin^2 /
// 2.
TEST_CASE("an ellipsoid rocks with the period of the textbook, and never more than it did") {
    for (const vec3 radii : {vec3(0.5f, 0.3f, 0.4f), vec3(0.3f, 0.25f, 0.5f)}) {
        const float angle = 0.03f, a2 = radii.x * radii.x, b2 = radii.y * radii.y;
        Scene scene;
        scene.bodies = {ground(), body_of(Ellipsoid{radii}, {0, radii.y, 0}, {0, 0, angle / 2, 1})};
        for (Body& body : scene.bodies) body.friction = 1;
        Settings settings;
        settings.sleeping = false;
        World world(scene, settings, 1);
        std::vector<double> crossings;
        double before = angle, late = 0;
        for (int k = 1; k <= 600; ++k) {
            world.step(1);
            const double now = 2 * std::asin(static_cast<double>(world.body(1).orientation.z));
            if (before * now < 0) crossings.push_back((k - now / (now - before)) / 60);
            if (k > 480) late = std::max(late, std::abs(now));
            before = now;
        }
        const double frequency = std::sqrt(static_cast<double>(g * (a2 - b2) / radii.y / ((a2 + b2) / 5 + b2)));
        REQUIRE(crossings.size() > 6);
        const double period = 2 * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
        CHECK(period == Approx(2 * 3.14159265 / frequency).epsilon(0.005));
        CHECK(late < 1.01 * static_cast<double>(angle));
        CHECK(late > 0.75 * static_cast<double>(angle));
    }
}

TEST_CASE("an ellipsoid of equal radii rolls down a slope as a sphere does") {
    const float slope = 0.25f;
    Scene scene;
    scene.gravity = {g * std::sin(slope), -g * std::cos(slope), 0};
    scene.bodies = {ground(), body_of(Ellipsoid{vec3(0.3f)}, {0, 0.3f, 0}), body_of(Sphere{0.3f}, {0, 0.3f, 3})};
    for (Body& body : scene.bodies) body.friction = 0.8f;
    World world(scene, {}, 1);
    world.step(120);
    const BodyState ellipsoid = world.body(1), sphere = world.body(2);
    CHECK(ellipsoid.velocity.x == Approx(5.0 / 7 * static_cast<double>(scene.gravity.x) * 2).epsilon(0.01));
    CHECK(ellipsoid.position.x == Approx(sphere.position.x).epsilon(0.002));
    CHECK(ellipsoid.position.y == Approx(sphere.position.y).margin(1e-4));
}

TEST_CASE("an ellipsoid that tumbles freely keeps its angular momentum and its energy") {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {body_of(Ellipsoid{{0.5f, 0.3f, 0.4f}}, {})};
    scene.bodies[0].angular_velocity = {0.05f, 0.02f, 4};  // about the intermediate axis, which is unstable
    const MassProperties mass = mass_properties(scene.bodies[0].shape, 1000);
    World world(scene, {}, 1);
    const vec3 before = angular_momentum(world.body(0), mass);
    const float energy = glm::dot(before, world.body(0).angular_velocity);
    world.step(600);
    const vec3 after = angular_momentum(world.body(0), mass);
    CHECK(glm::length(after - before) < 1e-3f * glm::length(before));
    CHECK(glm::dot(after, world.body(0).angular_velocity) == Approx(energy).epsilon(0.01));
}

TEST_CASE("a fast ellipsoid does not pass through a thin wall") {
    for (const float speed : {20.0f, 90.0f, 400.0f}) {
        Scene scene;
        scene.gravity = vec3(0);
        scene.bodies = {body_of(Box{{0.02f, 3, 3}}, {5, 0, 0}), body_of(Ellipsoid{{0.3f, 0.1f, 0.2f}}, {})};
        scene.bodies[0].motion = Motion::fixed;
        scene.bodies[1].velocity = {speed, 1, 0};
        scene.bodies[1].angular_velocity = {3, 9, -5};
        World world(scene, {}, 1);
        world.step(60);
        CAPTURE(speed);
        CHECK(world.body(1).position.x < 5);
    }
}

TEST_CASE("a pile of ellipsoids, alone and as parts of compounds, comes to rest without overlap") {
    std::mt19937 chance(3);
    const auto any = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(chance); };
    Scene scene;
    scene.bodies.assign(5, ground());  // a pit
    const vec3 walls[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
    for (std::size_t k = 0; k < 4; ++k) scene.bodies[k + 1].shape = Plane{walls[k], -1.1f};
    for (int k = 0; k < 60; ++k) {
        const Ellipsoid stone{{any(0.2f, 0.4f), any(0.15f, 0.3f), any(0.2f, 0.35f)}};
        const vec3 place{any(-0.6f, 0.6f), 0.5f + 0.3f * static_cast<float>(k), any(-0.6f, 0.6f)};
        Body body = body_of(stone, place, {any(-1, 1), any(-1, 1), any(-1, 1), any(0.1f, 1)});
        if (k % 5 == 0) body.shape = Compound{{{stone, {-0.2f, 0, 0}}, {Ellipsoid{{0.2f, 0.2f, 0.15f}}, {0.25f, 0.1f, 0}}}};
        body.rolling_resistance = 0.01f;
        scene.bodies.push_back(body);
    }
    World world(scene, {}, 1);
    world.step(900);
    float fastest = 0;
    for (std::size_t i = 5; i < scene.bodies.size(); ++i) {
        fastest = std::max(fastest, glm::length(world.body(i).velocity));
        CHECK(world.body(i).position.y > 0.1f);
    }
    CHECK(fastest < 1e-3f);
    CHECK(world.statistics().penetration_max < 0.02);
}

TEST_CASE("an ellipsoid is met by a ray where its surface is, and breaks into pieces that weigh as much") {
    const vec4 upright(0, 0, 0, 1), lying(0, 0, std::sqrt(0.5f), std::sqrt(0.5f));
    const Ellipsoid stone{{1, 0.5f, 2}};
    const Shape shape = stone;
    CHECK(ray_distance(shape, vec3(0), upright, {0, 5, 0}, {0, -1, 0}).value() == Approx(4.5f));
    CHECK(ray_distance(shape, vec3(0), lying, {0, 5, 0}, {0, -1, 0}).value() == Approx(4));
    CHECK(ray_distance(shape, vec3(0), upright, {0.6f, 5, 0}, {0, -1, 0}).value() == Approx(5 - 0.4f));
    CHECK_FALSE(ray_distance(shape, vec3(0), upright, {1.01f, 5, 0}, {0, -1, 0}));
    CHECK_FALSE(ray_distance(shape, vec3(0), upright, {0, 0.4f, 0}, {0, -1, 0}));  // origin inside
    Scene scene;
    scene.bodies = {body_of(stone, {})};
    scene.bodies[0].fracture = Fracture{.impulse = 10, .pieces = 20};
    const Scene cut = checked(scene);
    REQUIRE(cut.bodies.size() == 21);
    double sum = 0;
    for (std::size_t i = 1; i < cut.bodies.size(); ++i) {
        sum += mass_properties(cut.bodies[i].shape, cut.bodies[i].density).mass;
        const vec3 in_radii = cut.bodies[i].position / stone.radii;
        CHECK(glm::length(in_radii) < 1);
    }
    CHECK(sum == Approx(mass_properties(stone, 1000).mass).epsilon(1e-4));
}
