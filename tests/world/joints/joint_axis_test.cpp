// Joint axes with a spring, damping, friction and limits together, motors against springs, and forces each step.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "compute/scene_file/scene_json.h"
#include "compute/world.h"

using namespace scree;

namespace {

constexpr float mass = 8;  // kg

Scene slider(const Axis& axis, float start) {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies.push_back({.shape = Box{vec3(0.1f)}});
    scene.joints.push_back(joint_at(scene, Slider{axis}, the_world, 0, vec3(0)));
    scene.bodies[0].position.x = start;
    return scene;
}

float place(const World& world) {
    return world.joint(0).coordinates[0];
}

}  // namespace

TEST_CASE("a spring with dry friction loses 2 F / k of its amplitude in every half period, and stops within F / k") {
    for (const float stiffness : {400.0f, 40000.0f}) {  // explicit, and as stiff as 72 rad/s at 480 Hz
        const float friction = 0.1f * stiffness * 0.5f;
        World world(slider({.spring = Spring{.stiffness = stiffness}, .friction = friction}, 0.5f), {.rate = 240});
        const float half_period = 3.14159f * std::sqrt(mass / stiffness);
        std::vector<float> turns;
        float before = 0.5f, direction = -1;
        for (int i = 0; i < static_cast<int>(240 * 8 * half_period); ++i) {
            world.step();
            const float now = place(world);
            if ((now - before) * direction < -1e-6f) turns.push_back(before), direction = -direction;
            before = now;
        }
        INFO("stiffness " << stiffness);
        REQUIRE(turns.size() >= 3);
        const float margin = stiffness > 1000 ? 0.05f : 0.01f;
        CHECK(turns[0] == Approx(-0.4f).margin(margin));
        CHECK(turns[1] == Approx(0.3f).margin(margin));
        CHECK(turns[2] == Approx(-0.2f).margin(margin));
        CHECK(std::abs(place(world)) <= friction / stiffness + 1e-3f);
        CHECK(std::abs(world.body(0).velocity.x) < 1e-4f);
    }
}

TEST_CASE("what friction holds stays where the spring pulls no harder") {
    World world(slider({.spring = Spring{.stiffness = 400, .damping = 5}, .friction = 50}, 0.12f));
    world.step(600);
    CHECK(place(world) == Approx(0.12f).margin(1e-4));
}

TEST_CASE("a motor works against a spring up to its greatest force, and within limits") {
    World world(slider({.spring = Spring{.stiffness = 400, .damping = 40}, .motor = Motor{.speed = 2, .max_force = 60}}, 0));
    world.step(600);
    CHECK(place(world) == Approx(60.0f / 400).epsilon(0.01));
    World limited(slider({.limits = Limits{-0.05f, 0.1f},
                          .spring = Spring{.stiffness = 400, .damping = 40},
                          .motor = Motor{.speed = 2, .max_force = 60}},
                         0));
    limited.step(600);
    CHECK(place(limited) == Approx(0.1f).margin(1e-3));
}

TEST_CASE("forces and torques on joint axes act in the next step, and conserve momentum") {
    World world(slider({}, 0));
    for (int i = 0; i < 60; ++i) {
        world.apply_joint_forces(std::vector{JointForce{0, JointAxis::x, 5}, JointForce{0, JointAxis::x, 3}});
        world.step();
    }
    CHECK(world.body(0).velocity.x == Approx(8.0f / mass).epsilon(1e-3));
    world.step(30);
    CHECK(world.body(0).velocity.x == Approx(8.0f / mass).epsilon(1e-3));
    Scene two;
    two.gravity = vec3(0);
    two.bodies.push_back({.shape = Box{vec3(0.3f, 0.1f, 0.1f)}});
    two.bodies.push_back({.shape = Box{vec3(0.2f, 0.1f, 0.3f)}, .position = {0.6f, 0, 0}});
    two.joints.push_back(joint_at(two, Hinge{}, 0, 1, {0.35f, 0, 0}, {0, 1, 0}));
    World pair(two);
    for (int i = 0; i < 30; ++i) {
        pair.apply_joint_forces(std::vector{JointForce{0, JointAxis::twist, 2}});
        pair.step();
    }
    const Statistics after = pair.statistics();
    for (int k = 0; k < 3; ++k) {
        CHECK(std::abs(after.momentum[k]) < 1e-3);
        CHECK(std::abs(after.angular_momentum[k]) < 1e-3);
    }
    CHECK(pair.body(1).angular_velocity.y - pair.body(0).angular_velocity.y > 0.1f);
    using Catch::Contains;
    CHECK_THROWS_WITH(pair.apply_joint_forces(std::vector{JointForce{0, JointAxis::x, NAN}}), Contains("not finite"));
    CHECK_THROWS_AS(pair.apply_joint_forces(std::vector{JointForce{4}}), std::out_of_range);
}

TEST_CASE("scene files take a spring beside friction or a motor, and refuse what cannot be together") {
    const auto read = [](const std::string& axis) {
        return checked(scene_from_json(R"({"bodies": [{"shape": {"sphere": {"radius": 1}}}],
            "joints": [{"kind": {"slider": {)" +
                                       axis + R"(}}, "b": 0, "anchor": [0, 0, 0]}]})")
                           .scene);
    };
    const std::string spring = R"("spring": {"stiffness": 10, "damping": 1}, )";
    const Scene scene = read(spring + R"("friction": 3, "limits": {"lower": -1, "upper": 1})");
    CHECK(scene_to_json(scene_from_json(scene_to_json(scene)).scene) == scene_to_json(scene));
    CHECK_THROWS_WITH(read(R"("motor": {"speed": 1, "max_force": 2}, "friction": 3)"),
                      Catch::Contains("at most one of motor and friction"));
    CHECK_THROWS_WITH(read(R"("spring": {"stiffness": 10, "max_force": 5}, "friction": 3)"),
                      Catch::Contains("/joints/0/kind/slider/spring/max_force"));
}
