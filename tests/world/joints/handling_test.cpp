// Grabbing and adding bodies and changing settings while a world runs.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "compute/world.h"
#include "shaders/physics/base/arithmetic.h"
#include "tests/world/heaps.h"

using namespace scree;
using tests::ground;

namespace {

Body shaped(Shape shape, vec3 position) {
    Body body;
    body.shape = shape;
    body.position = position;
    return body;
}
Scene one(Shape shape, vec3 gravity = vec3(0)) {
    Scene scene;
    scene.gravity = gravity;
    scene.bodies = {shaped(shape, vec3(0))};
    return scene;
}
Scene stack(int boxes) {
    Scene scene;
    scene.bodies = {ground()};
    for (int i = 0; i < boxes; ++i) scene.bodies.push_back(shaped(Box{}, vec3(0, 0.5f + static_cast<float>(i), 0)));
    return scene;
}
vec3 point_of(const BodyState& body, vec3 anchor) {
    return body.position + physics::rotate(body.orientation, anchor);
}

}  // namespace

TEST_CASE("a grip pulls as an implicit damped spring does") {
    for (const Shape& shape : {Shape(Sphere{0.5f}), Shape(Box{vec3(0.1f, 0.4f, 2)}), Shape(Capsule{0.1f, 1})}) {
        World world(one(shape), {.substeps = 1});
        world.grip(0, vec3(0), vec3(0.1f, -0.2f, 0.3f), {.hertz = 2, .damping_ratio = 0.5f});
        world.step();
        const float h = 1.0f / 60, w = 2 * 3.14159265f * 2;
        const vec3 expected = vec3(0.1f, -0.2f, 0.3f) * (h * w * w / (1 + 2 * 0.5f * w * h + h * h * w * w));
        REQUIRE(glm::length(world.bodies()[0].velocity - expected) < 1e-5f);
        REQUIRE(world.bodies()[0].angular_velocity == vec3(0));
    }
}

TEST_CASE("a point of a body off its centre answers a grip with the speed of the spring, whatever the body's inertia") {
    for (const Shape& shape : {Shape(Sphere{0.5f}), Shape(Box{vec3(0.1f, 0.4f, 2)}), Shape(Capsule{0.1f, 1})}) {
        World world(one(shape), {.substeps = 1});
        const vec3 anchor(0.1f, 0.3f, 0.05f);
        world.grip(0, anchor, anchor + vec3(0.01f, -0.02f, 0.03f), {.hertz = 2, .damping_ratio = 0.5f});
        world.step();
        const float h = 1.0f / 60, w = 2 * 3.14159265f * 2;
        const vec3 expected = vec3(0.01f, -0.02f, 0.03f) * (h * w * w / (1 + 2 * 0.5f * w * h + h * h * w * w));
        const BodyState body = world.bodies()[0];
        const vec3 found = body.velocity + glm::cross(body.angular_velocity, anchor);
        REQUIRE(glm::length(found - expected) < 2e-3f * glm::length(expected));
    }
}

TEST_CASE("a held body hangs by the point where it is held, g / w^2 below the target, and falls when released") {
    World world(one(Box{vec3(0.2f, 0.3f, 0.4f)}, vec3(0, -9.81f, 0)));
    const vec3 anchor(0.2f, 0.3f, 0.4f);
    const std::size_t grip = world.grip(0, anchor, vec3(0, 5, 0));
    world.step(1200);
    const BodyState body = world.body(0);
    const float w = 2 * 3.14159265f * 5;
    REQUIRE(glm::length(point_of(body, anchor) - vec3(0, 5 - 9.81f / (w * w), 0)) < 2e-3f);
    REQUIRE(glm::length(body.velocity) < 0.01f);
    REQUIRE(body.position.y < 5 - 0.5f);  // its centre below the grabbed corner
    world.release(grip);
    world.step(30);
    REQUIRE(world.body(0).velocity.y < -4.5f);
}

TEST_CASE("a grip never pulls harder than it may, however far its target jumps") {
    Scene scene = stack(5);
    World world(scene);
    const std::size_t grip = world.grip(3, vec3(0.5f), vec3(0, 1e6f, 0));
    world.step();
    REQUIRE(world.body(3).velocity.y > 0.5f);
    REQUIRE(world.body(3).velocity.y < 300.0f / 60);
    for (int step = 0; step < 120; ++step) {
        world.move_grip(grip, step % 2 == 0 ? vec3(0, 1e6f, 0) : vec3(0, -1e6f, 1e5f));
        world.step();
        REQUIRE(world.statistics().max_speed < 400 * 1.001);
    }
    world.move_grip(grip, vec3(3, 4, 0));
    world.step(300);
    const Statistics end = world.statistics();
    REQUIRE(end.not_finite == 0);
    REQUIRE(end.below_ground == 0);
    REQUIRE(glm::length(point_of(world.body(3), vec3(0.5f)) - vec3(3, 4, 0)) < 0.05f);
}

TEST_CASE("a body in the grip is carried across and set down on another") {
    Scene scene = stack(1);
    scene.bodies.push_back(shaped(Box{vec3(0.3f)}, vec3(3, 0.3f, 0)));
    World world(scene);
    const std::size_t grip = world.grip(2, vec3(0, 0.3f, 0), vec3(3, 2, 0));
    world.step(60);
    for (int i = 0; i < 120; ++i) {
        world.move_grip(grip, vec3(3 - 0.025f * static_cast<float>(i + 1), 2, 0));
        world.step();
    }
    world.step(180);
    world.move_grip(grip, vec3(0, 1.6f, 0));
    world.step(60);
    world.release(grip);
    world.step(120);
    const vec3 end = world.body(2).position;
    REQUIRE(std::abs(end.x) < 0.05f);
    REQUIRE(end.y == Approx(1.3f).margin(0.02));
    REQUIRE(std::abs(world.body(1).position.x) < 0.02f);
}

TEST_CASE("whoever is taken hold of wakes, and what lay on it falls") {
    World world(stack(3));
    world.step(240);
    REQUIRE(world.statistics().asleep == 3);
    const std::size_t grip = world.grip(1, vec3(0), vec3(5, 0.6f, 0));
    world.step(90);
    REQUIRE(world.body(1).position.x > 4);
    REQUIRE(world.body(3).position.y < 1.8f);
    REQUIRE_FALSE(world.body(1).asleep);
    world.release(grip);
    world.step(240);
    REQUIRE(world.statistics().asleep == 3);
}

TEST_CASE("gravity changes at once, also for sleepers") {
    World world(stack(2));
    world.step(240);
    REQUIRE(world.statistics().asleep == 2);
    world.set_gravity(vec3(0, 5, 0));
    world.step(60);
    REQUIRE(world.body(2).velocity.y == Approx(5).margin(0.02));
    REQUIRE(world.scene().gravity.y == 5);
    REQUIRE_THROWS_AS(world.set_gravity(vec3(0, std::nanf(""), 0)), SceneError);
}

TEST_CASE("friction changes at once for all bodies") {
    Scene scene = stack(1);
    scene.bodies[1].velocity = vec3(3, 0, 0);
    for (const float factor : {0.0f, 0.5f, 1.0f}) {
        World world(scene);
        world.set_friction_factor(factor);
        world.step(30);
        REQUIRE(world.body(1).velocity.x == Approx(std::max(0.0f, 3 - factor * 0.6f * 9.81f * 0.5f)).margin(0.05));
    }
    World asleep(stack(1));
    asleep.step(120);
    asleep.set_friction_factor(0);
    asleep.set_gravity(vec3(1, -9.81f, 0));
    asleep.step(60);
    REQUIRE(asleep.body(1).velocity.x == Approx(1).margin(0.02));
    REQUIRE_THROWS_WITH(asleep.set_friction_factor(-1), Catch::Contains("friction_factor"));
    REQUIRE_THROWS_WITH(asleep.set_friction_factor(std::nanf("")), Catch::Contains("friction_factor"));
}

TEST_CASE("restitution changes at once for all bodies") {
    Scene scene;
    scene.bodies = {ground(), shaped(Sphere{0.5f}, vec3(0, 2.5f, 0))};
    World world(scene);
    world.set_least_restitution(0.8f);
    world.step(38);
    float top = 0;
    for (int i = 0; i < 60; ++i) {
        world.step();
        top = std::max(top, world.body(1).position.y);
    }
    REQUIRE(top - 0.5f == Approx(0.64f * 2).epsilon(0.02));
    REQUIRE_THROWS_WITH(world.set_least_restitution(1.5f), Catch::Contains("least_restitution"));
}

TEST_CASE("the number of substeps changes without a jolt, and its stiffness with it") {
    World world(stack(5), {.sleeping = false});
    world.step(120);
    for (const int substeps : {16, 8, 5, 8}) {
        CAPTURE(substeps);
        world.set_substeps(substeps);
        REQUIRE(world.settings().substeps == substeps);
        for (int i = 0; i < 10; ++i) {
            world.step();
            REQUIRE(world.statistics().max_speed < 0.08);
        }
        world.step(60);
    }
    REQUIRE(world.statistics().drift_max < 0.05);
    REQUIRE_THROWS_WITH(world.set_substeps(0), Catch::Contains("substeps"));
    REQUIRE(world.settings().substeps == 8);
}

TEST_CASE("a body that is added before the first step is as good as one of the scene") {
    const Scene all = stack(6);
    Scene most = all;
    most.bodies.pop_back();
    World whole(all), added(most);
    REQUIRE(added.add_body(all.bodies.back()) == 6);
    whole.step(60);
    added.step(60);
    REQUIRE(added.state_hash() == whole.state_hash());
}

TEST_CASE("bodies that are added fall onto those that are there, and wake them") {
    World world(stack(2));
    world.step(240);
    REQUIRE(world.statistics().asleep == 2);
    for (int i = 0; i < 100; ++i) {
        Body ball = shaped(Sphere{0.2f}, vec3(0.01f * static_cast<float>(i % 7), 4, 0.01f * static_cast<float>(i % 5)));
        ball.velocity = vec3(0, -5, 0);
        REQUIRE(world.add_body(ball) == static_cast<std::size_t>(3 + i));
        world.step(4);
    }
    world.step(120);
    const Statistics end = world.statistics();
    REQUIRE(end.bodies == 103);
    REQUIRE(end.not_finite == 0);
    REQUIRE(end.below_ground == 0);
    REQUIRE(end.penetration_max < 0.05);
    Body wrong = shaped(Sphere{-1}, vec3(0));
    REQUIRE_THROWS_AS(world.add_body(wrong), SceneError);
    REQUIRE(world.scene().bodies.size() == 103);
}

TEST_CASE("a world without bodies takes the first") {
    World world{Scene{}};
    world.step();
    REQUIRE(world.add_body(shaped(Box{}, vec3(0, 5, 0))) == 0);
    REQUIRE(world.add_body(ground()) == 1);
    world.step(180);
    REQUIRE(world.body(0).position.y == Approx(0.5f).margin(0.01));
}

TEST_CASE("an explosion gives speeds that fall to nothing at its edge") {
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < 4; ++i) scene.bodies.push_back(shaped(Sphere{0.1f}, vec3(static_cast<float>(i), 0, 0)));
    scene.bodies.push_back(ground());
    World world(scene);
    world.explode(vec3(0), 3, 12);
    world.step();
    REQUIRE(world.body(0).velocity == vec3(0, 12, 0));
    REQUIRE(world.body(1).velocity.x == Approx(8));
    REQUIRE(world.body(2).velocity.x == Approx(4));
    REQUIRE(world.body(3).velocity.x == 0);
    REQUIRE_THROWS_AS(world.explode(vec3(0), 0, 1), std::invalid_argument);
    REQUIRE_THROWS_AS(world.explode(vec3(0), 1, std::nanf("")), std::invalid_argument);
}

TEST_CASE("what touches a body carries its weight") {
    World world(stack(3));
    world.step(120);
    const float weight = 1000 * 9.81f;
    float up = 0, down = 0;
    for (const BodyContact& touching : world.contacts_of(2)) (touching.body == 1 ? up : down) += touching.force;
    REQUIRE(up == Approx(2 * weight).epsilon(0.01));
    REQUIRE(down == Approx(weight).epsilon(0.01));
    REQUIRE(world.contacts_of(0).size() == 1);
    REQUIRE(world.contacts_of(0)[0].points == 4);
}

TEST_CASE("a hold that makes no sense is refused by name, and leaves no trace") {
    World world(stack(2)), untouched(stack(2));
    constexpr float infinity = std::numeric_limits<float>::infinity();
    REQUIRE_THROWS_AS(world.grip(9, vec3(0), vec3(0)), std::out_of_range);
    REQUIRE_THROWS_WITH(world.grip(0, vec3(0), vec3(0)), Catch::Contains("not dynamic"));
    REQUIRE_THROWS_AS(world.grip(1, vec3(std::nanf("")), vec3(0)), std::invalid_argument);
    REQUIRE_THROWS_AS(world.grip(1, vec3(0), vec3(infinity)), std::invalid_argument);
    REQUIRE_THROWS_WITH(world.grip(1, vec3(0), vec3(0), {.hertz = 0}), Catch::Contains("hertz"));
    REQUIRE_THROWS_WITH(world.grip(1, vec3(0), vec3(0), {.damping_ratio = -1}), Catch::Contains("damping_ratio"));
    REQUIRE_THROWS_AS(world.move_grip(0, vec3(0)), std::out_of_range);
    REQUIRE_THROWS_AS(world.release(7), std::out_of_range);
    world.step();
    untouched.step();
    REQUIRE(world.state_hash() == untouched.state_hash());
    for (std::size_t i = 0; i < most_grips; ++i) REQUIRE(world.grip(1, vec3(0), vec3(0, 9, 0)) == i);
    REQUIRE_THROWS_AS(world.grip(2, vec3(0), vec3(0)), std::length_error);
    world.release(2);
    REQUIRE(world.grip(2, vec3(0), vec3(0)) == 2);
}
