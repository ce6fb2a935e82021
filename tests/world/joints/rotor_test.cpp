// Rotors of joints (armature) that are far heavier than their links, that sleep, and that are pushed as they begin or wake.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "compute/runner.h"
#include "compute/world.h"
#include "tests/world/joints/joint_scenes.h"

using namespace scree;
using tests::energy;
using tests::slider;

namespace {

// A link of 0.2 m from the z axis along x, solid with this mass.
Body link(float mass, vec3 start = vec3(0)) {
    Body body;
    body.shape = Box{{0.1f, 0.02f, 0.02f}};
    body.inertial = Inertial{.mass = mass, .inertia = mass / 12 * vec3(0.0032f, 0.0416f, 0.0416f)};
    body.position = start + vec3(0.1f, 0, 0);
    body.filter = Filter{1, 0, 0};
    return body;
}

Scene arm(const Axis& axis, float mass) {
    Scene scene;
    scene.gravity = {0, -10, 0};
    scene.bodies.push_back(link(mass));
    scene.joints.push_back(joint_at(scene, Hinge{axis}, the_world, 0, vec3(0), {0, 0, 1}));
    return scene;
}

}  // namespace

TEST_CASE("rotors that share an axis turn its link, whatever they weigh beside it") {
    for (const float mass : {0.04f, 1.0f})
        for (const float armature : {1e2f, 1e4f, 1e6f, 1e8f})
            for (const bool driven : {false, true}) {
                Axis axis{.armature = armature};
                if (driven) axis.motor = Motor{.speed = 2, .max_force = armature};
                Scene scene = arm(axis, mass);
                scene.joints.push_back(joint_at(scene, Hinge{axis}, the_world, 0, {0, 0, 0.05f}, {0, 0, 1}));
                if (!driven) {
                    scene.bodies[0].angular_velocity = {0, 0, 3};
                    scene.bodies[0].velocity = {0, 0.3f, 0};
                }
                World world(scene, {.sleeping = false});
                const double before = energy(world);
                INFO("rotors of " << armature << " kg m^2, link of " << mass << " kg, driven: " << driven);
                for (int n = 0; n < 300; ++n) {
                    world.step();
                    REQUIRE(world.quarantines().empty());
                    if (driven) continue;
                    // A rotor of 1e4 kg m^2 does not feel the link's weight in single precision: at most that is gained.
                    REQUIRE(energy(world) < before + 1.1 * static_cast<double>(mass));
                    REQUIRE(std::abs(world.body(0).angular_velocity.z - 3) < 0.01f);
                }
                CHECK(world.body(0).angular_velocity.z == Approx(driven ? 2 : 3).epsilon(3e-3));
            }
}

TEST_CASE("random arms with rotors from a gram to a mountain keep their bodies, and gain no energy") {
    std::mt19937 random(7);
    const auto between = [&](float a, float b) { return std::uniform_real_distribution<float>(a, b)(random); };
    for (int trial = 0; trial < 120; ++trial) {
        const int links = 1 + trial % 5;
        const float mass = std::pow(10.0f, between(-2, 1));
        Scene scene;
        scene.gravity = {0, -10, 0};
        bool passive = true;
        for (int k = 0; k < links; ++k) {
            const vec3 start(0.2f * static_cast<float>(k), 0, 0);
            scene.bodies.push_back(link(mass, start));
            for (int n = between(0, 1) < 0.3f ? 2 : 1; n > 0; --n) {  // two share an axis
                Axis axis{.armature = std::pow(10.0f, between(-4, 8))};
                const float kind = between(0, 1);
                if (kind < 0.2f)
                    axis.motor = Motor{.speed = between(-3, 3), .max_force = axis.armature * between(0, 2)};
                else if (kind < 0.4f)
                    axis.friction = between(0, 3);
                else if (kind < 0.6f)
                    axis.spring = Spring{.stiffness = std::pow(10.0f, between(0, 5)), .damping = between(0, 10)};
                else if (kind < 0.7f)
                    axis.limits = Limits{-between(0.1f, 1), between(0.1f, 1)};
                passive = passive && !axis.motor && !axis.spring;
                const vec3 anchor = start + vec3(0, 0, 0.05f * static_cast<float>(n));
                const std::size_t before = k == 0 ? the_world : static_cast<std::size_t>(k - 1);
                scene.joints.push_back(joint_at(scene, Hinge{axis}, before, static_cast<std::size_t>(k), anchor, {0, 0, 1}));
            }
        }
        World world(scene, {.sleeping = false});
        for (std::size_t k = 0; k < scene.bodies.size(); k += 2)
            world.apply_angular_impulse(k, {0, 0, mass * between(-0.1f, 0.1f)});
        world.step();
        const double start = energy(world), weight = 10 * 0.2 * static_cast<double>(mass) * links * links;  // work to lift it
        INFO("trial " << trial << ": " << links << " links of " << mass << " kg");
        for (int n = 0; n < 240; ++n) {
            world.step();
            REQUIRE(world.quarantines().empty());
            if (passive) REQUIRE(energy(world) < start + 0.02 * weight);
        }
    }
}

TEST_CASE("a motor drives a rotor of any inertia to its limit, and its link with it") {
    for (const float armature : {1e2f, 1e4f, 1e6f, 1e8f}) {
        World world(
            arm({.limits = Limits{-1, 1}, .motor = Motor{.speed = 2, .max_force = armature}, .armature = armature}, 0.04f));
        INFO("rotor of " << armature << " kg m^2");
        float farthest = 0;
        for (int n = 0; n < 300; ++n) {
            world.step();
            farthest = std::max(farthest, world.joint(0).coordinates[3]);
        }
        REQUIRE(world.quarantines().empty());
        CHECK(farthest < 1.005f);
        CHECK(world.joint(0).coordinates[3] == Approx(1).margin(2e-3));
        CHECK(std::abs(world.body(0).angular_velocity.z) < 1e-4f);
    }
}

TEST_CASE("an arm falls as slowly as its rotor lets it, and does not fall asleep on the way") {
    for (const float armature : {300.0f, 1e4f}) {
        World world(arm({.armature = armature}, 1));
        const double seconds = armature > 1e3f ? 60 : 10;
        world.step(static_cast<int>(60 * seconds));
        const double angle = 0.5 * (1 * 10 * 0.1) / (static_cast<double>(armature) + 0.0135) * seconds * seconds;  // small
        INFO("rotor of " << armature << " kg m^2");
        CHECK(-static_cast<double>(world.joint(0).coordinates[3]) == Approx(angle).epsilon(0.02));
        CHECK_FALSE(world.body(0).asleep);
    }
    World driven(slider({.motor = Motor{.speed = 1, .max_force = 5}, .armature = 1e4f}, 2));
    driven.step(60 * 60);
    CHECK(driven.body(0).position.x == Approx(0.5 * 5 / 10002 * 3600).epsilon(0.01));
}

TEST_CASE("arms with rotors sleep where they are held: by a motor, by friction, on the ground") {
    for (const float armature : {0.01f, 1.0f, 100.0f, 1e4f}) {
        INFO("rotor of " << armature << " kg m^2");
        World held(arm({.motor = Motor{.speed = 0, .max_force = 20}, .armature = armature}, 1));
        World braked(arm({.friction = 5, .armature = armature}, 1));
        Scene scene = arm({.armature = armature}, 1);
        scene.bodies[0].filter = Filter{};
        Body ground;
        ground.motion = Motion::fixed;
        ground.shape = Plane{{0, 1, 0}, -0.02f};
        scene.bodies.push_back(ground);
        World laid(scene);
        for (World* world : {&held, &braked, &laid}) {
            world->step(300);
            CHECK(world->body(0).asleep);
            CHECK(std::abs(world->joint(0).coordinates[3]) < 0.02f);
        }
    }
}

TEST_CASE("an impulse turns the rotor, too, as a world begins, as a body wakes, and on a joint that is new") {
    const float share = 40.2f / 402;
    World fresh(slider({.armature = 400}, 2));
    fresh.apply_impulse(0, {40.2f, 0, 0});
    fresh.step(3);
    CHECK(fresh.body(0).velocity.x == Approx(share).epsilon(1e-3));

    Scene moving = slider({.armature = 400}, 2);
    moving.bodies[0].velocity = {1, 0, 0};
    World underway(moving);
    underway.apply_impulse(0, {40.2f, 0, 0});
    underway.step(3);
    CHECK(underway.body(0).velocity.x == Approx(1 + share).epsilon(1e-3));

    World sleeper(slider({.friction = 1e-3f, .armature = 400}, 2));
    sleeper.step(120);
    REQUIRE(sleeper.body(0).asleep);
    sleeper.apply_impulse(0, {40.2f, 0, 0});
    sleeper.step(3);
    CHECK(sleeper.body(0).velocity.x == Approx(share).epsilon(2e-3));

    Scene two = slider({.armature = 400}, 2);
    const Joint joint = two.joints[0];
    two.joints.clear();
    two.bodies[0].velocity = {1, 0, 0};
    World joined(two);
    joined.step(3);
    joined.add_joint(joint);
    joined.apply_impulse(0, {40.2f, 0, 0});
    joined.step(3);
    CHECK(joined.body(0).velocity.x == Approx(1 + share).epsilon(1e-3));
}

TEST_CASE("rotors take velocities that are set, in a copy that is woken, too") {
    const auto set_and_woken = [](World& world) {
        world.step(3);
        world.set_bodies(std::vector<BodyChange>{{.body = 0, .velocity = vec3(2, 0, 0)}});
        world.wake_copy(0);
        world.step(30);
        CHECK(world.body(0).velocity.x == Approx(2).epsilon(1e-3));
    };
    World one(slider({.armature = 400}, 2));
    set_and_woken(one);
    World copies(slider({.armature = 400}, 2), {}, make_reference_runner(1), 2);
    set_and_woken(copies);
    CHECK(copies.body(1).velocity.x == 0);
    copies.reset_copy(0);
    copies.apply_impulse(0, {40.2f, 0, 0});
    copies.step(3);
    CHECK(copies.body(0).velocity.x == Approx(0.1f).epsilon(1e-3));
}
