// Armature: the inertia of a rotor that turns with a joint's axis, against closed forms and a double pendulum in double
// precision.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/world/joints/joint_scenes.h"

using namespace scree;
using tests::energy;
using tests::slider;

namespace {

constexpr float pi = 3.14159265f;

// A body of 2 kg and 0.3 kg m^2 about its centre, on a hinge about z at the origin, `arm` below.
Scene pendulum(const Axis& axis, float arm, float angle = 0) {
    Scene scene;
    scene.gravity = {0, -10, 0};
    Body body;
    body.shape = Box{vec3(0.1f)};
    body.inertial = Inertial{.mass = 2, .inertia = vec3(0.3f)};
    body.position = {0, -arm, 0};
    scene.bodies.push_back(body);
    scene.joints.push_back(joint_at(scene, Hinge{axis}, the_world, 0, vec3(0), {0, 0, 1}));
    scene.bodies[0].position = {arm * std::sin(angle), -arm * std::cos(angle), 0};
    scene.bodies[0].orientation = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
    return scene;
}

// Two links with a rotor each, about z: angles from straight down, rates. Link: mass, inertia about its centre, its
// length, centre at half of it. Lagrange's equations, fourth-order Runge-Kutta.
struct DoublePendulum {
    double m, i, l, g, rotor1, rotor2;  // rotor 2 turns with the difference of the angles
    std::array<double, 4> state;

    std::array<double, 4> rates(const std::array<double, 4>& s) const {
        const double c = l / 2, d = s[0] - s[1], sine = std::sin(d), cosine = std::cos(d);
        const double a11 = i + m * c * c + m * l * l + rotor1 + rotor2, a22 = i + m * c * c + rotor2;
        const double a12 = m * l * c * cosine - rotor2;
        const double b1 = -m * l * c * sine * s[3] * s[3] - (m * c + m * l) * g * std::sin(s[0]);
        const double b2 = m * l * c * sine * s[2] * s[2] - m * c * g * std::sin(s[1]);
        const double det = a11 * a22 - a12 * a12;
        return {s[2], s[3], (a22 * b1 - a12 * b2) / det, (a11 * b2 - a12 * b1) / det};
    }
    void advance(double time, int steps) {
        const double h = time / steps;
        const auto moved = [&](const std::array<double, 4>& by, double f) {
            std::array<double, 4> at = state;
            for (std::size_t k = 0; k < 4; ++k) at[k] += f * by[k];
            return at;
        };
        for (int n = 0; n < steps; ++n) {
            const auto k1 = rates(state), k2 = rates(moved(k1, h / 2)), k3 = rates(moved(k2, h / 2)), k4 = rates(moved(k3, h));
            for (std::size_t k = 0; k < 4; ++k) state[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
        }
    }
};

}  // namespace

TEST_CASE("armature adds to the inertia of its axis: an axis driven by a force accelerates as F / (m + armature)") {
    for (const float armature : {0.5f, 8.0f, 400.0f}) {
        World world(slider({.armature = armature}, 2));
        for (int n = 0; n < 60; ++n) {
            world.apply_joint_forces(std::vector{JointForce{0, JointAxis::x, 12}});
            world.step();
        }
        CHECK(world.body(0).velocity.x == Approx(12 / (2 + armature)).epsilon(1e-4));
        world.step(120);  // the rotor keeps it going
        CHECK(world.body(0).velocity.x == Approx(12 / (2 + armature)).epsilon(1e-4));
    }
}

TEST_CASE("a motor at its greatest force runs an axis with armature up as long as its momentum takes") {
    for (const bool sprung : {false, true}) {
        Axis axis{.motor = Motor{.speed = 3, .max_force = 20}, .armature = 18};
        if (sprung) axis.spring = Spring{.stiffness = 1e-3f};
        World world(slider(axis, 2));
        world.step(60);
        CHECK(world.body(0).velocity.x == Approx(1).epsilon(2e-3));  // 20 N for 1 s on 20 kg
        world.step(180);
        CHECK(world.body(0).velocity.x == Approx(3).epsilon(1e-3));
        CHECK(world.statistics().kinetic_energy == Approx(0.5 * 20 * 9).epsilon(2e-3));
    }
}

TEST_CASE("a pendulum with armature keeps its energy and swings with the period of the summed inertia") {
    for (const float armature : {0.0f, 0.3f, 5.0f}) {
        constexpr float arm = 0.5f;
        World world(pendulum({.armature = armature}, arm, 0.05f), {.rate = 120});
        const double all = 0.3 + 2 * 0.25 + static_cast<double>(armature);
        const double period = 2 * static_cast<double>(pi) * std::sqrt(all / (2 * 10 * 0.5));
        const double before = energy(world), amplitude = 2 * 10 * 0.5 * (1 - std::cos(0.05));
        int crossings = 0;
        double first = 0, last = 0, greatest = 0;
        float x = world.body(0).position.x;
        for (int n = 0; n < 120 * 40; ++n) {
            world.step();
            const float now = world.body(0).position.x;
            if (x > 0 && now <= 0) {
                last = (n + static_cast<double>(x) / static_cast<double>(x - now)) / 120;
                if (crossings++ == 0) first = last;
            }
            x = now;
            greatest = std::max(greatest, std::abs(energy(world) - before));
        }
        INFO("armature " << armature);
        REQUIRE(crossings > 5);
        CHECK((last - first) / (crossings - 1) == Approx(period * (1 + 0.05 * 0.05 / 16)).epsilon(1e-3));
        CHECK(greatest < 0.03 * amplitude);
    }
}

TEST_CASE("a double pendulum with a rotor in each joint moves as Lagrange's equations say") {
    const float half = 0.4f;
    Scene scene;
    scene.gravity = {0, -9.81f, 0};
    std::size_t before = the_world;
    for (int k = 0; k < 2; ++k) {
        Body link;
        link.shape = Box{{half, 0.05f, 0.05f}};
        link.inertial = Inertial{.mass = 1.5f, .inertia = {0.01f, 0.08f, 0.08f}};
        link.position = {half + 2 * half * static_cast<float>(k), 0, 0};
        scene.bodies.push_back(link);
        const std::size_t now = scene.bodies.size() - 1;
        scene.joints.push_back(joint_at(scene, Hinge{{.armature = k == 0 ? 0.4f : 0.15f}}, before, now,
                                        {2 * half * static_cast<float>(k), 0, 0}, {0, 0, 1}));
        before = now;
    }
    World world(scene, {.rate = 240});
    DoublePendulum exact{1.5, 0.08, 0.8, 9.81, 0.4, 0.15, {pi / 2, pi / 2, 0, 0}};
    const double start = energy(world);
    for (int n = 0; n < 24; ++n) {  // 2.4 s, in which both links swing through
        world.step(24);
        exact.advance(0.1, 200);
        for (std::size_t k = 0; k < 2; ++k) {
            const vec4 q = world.body(k).orientation;
            const double angle = 2 * std::atan2(q.z, q.w);  // from the x axis
            const double expected = exact.state[k] - static_cast<double>(pi) / 2;
            INFO("link " << k << " after " << 0.1 * (n + 1) << " s");
            CHECK(std::abs(std::remainder(angle - expected, 2 * static_cast<double>(pi))) < 0.02);
        }
        CHECK(std::abs(energy(world) - start) < 0.05);  // of 12 J
    }
}

TEST_CASE("a rotor slows what rolls down a slope on contacts, by its inertia over the radius squared") {
    for (const float armature : {0.0f, 2.0f}) {
        const float slope = 0.2f, radius = 0.3f;
        Scene scene;
        scene.gravity = 9.81f * vec3(std::sin(slope), -std::cos(slope), 0);
        Body ground;
        ground.motion = Motion::fixed;
        ground.shape = Plane{};
        scene.bodies.push_back(ground);
        Body wheel;
        wheel.shape = Sphere{radius};
        wheel.inertial = Inertial{.mass = 10, .inertia = vec3(0.4f)};
        wheel.position = {0, radius, 0};
        scene.bodies.push_back(wheel);
        Body carriage;  // moves with the wheel and does not turn
        carriage.shape = Box{vec3(0.05f)};
        carriage.inertial = Inertial{.mass = 5, .inertia = vec3(0.2f)};
        carriage.position = wheel.position;
        carriage.filter = Filter{1, 0, 0};
        scene.bodies.push_back(carriage);
        scene.joints.push_back(joint_at(scene, Hinge{{.armature = armature}}, 2, 1, wheel.position, {0, 0, 1}));
        SixDof upright;
        upright.twist.locked = upright.swing_y.locked = upright.swing_z.locked = true;
        scene.joints.push_back(joint_at(scene, upright, the_world, 2, wheel.position));
        World world(scene);
        world.step(120);
        const double expected = 15 * 9.81 * std::sin(0.2) / (15 + (0.4 + static_cast<double>(armature)) / 0.09) * 2;
        INFO("armature " << armature);
        CHECK(static_cast<double>(world.body(1).velocity.x) == Approx(expected).epsilon(0.01));
        CHECK(static_cast<double>(-world.body(1).angular_velocity.z) == Approx(expected / 0.3).epsilon(0.01));
    }
}

TEST_CASE("springs explicit and implicit, and limits, act on the rotor as on the body") {
    for (const float stiffness : {100.0f, 4e5f}) {
        World world(slider({.spring = Spring{.stiffness = stiffness}, .armature = 6}, 2), {.rate = 240});
        const float omega = std::sqrt(stiffness / 8);
        world.set_bodies(std::vector<BodyChange>{{.body = 0, .position = vec3(0.2f, 0, 0)}});
        const int half = static_cast<int>(std::lround(240 * pi / omega));
        if (half < 4) continue;
        world.step(half);
        CHECK(world.body(0).position.x == Approx(-0.2f).margin(0.01));
    }
    World stopped(slider({.limits = Limits{-1, 0.5f}, .armature = 6}, 2));
    stopped.apply_joint_forces(std::vector{JointForce{0, JointAxis::x, 60 * 16}});
    stopped.step();
    REQUIRE(stopped.body(0).velocity.x == Approx(2).epsilon(1e-3));
    stopped.step(60);
    CHECK(stopped.body(0).position.x == Approx(0.5f).margin(1e-3));
    CHECK(std::abs(stopped.body(0).velocity.x) < 1e-3f);
}

TEST_CASE("velocities that are set hold for rotors, too, and two bodies with a rotor between them keep their momentum") {
    World set(pendulum({.armature = 3}, 0));
    set.set_gravity(vec3(0));
    set.step(5);
    set.set_bodies(std::vector<BodyChange>{{.body = 0, .angular_velocity = vec3(0, 0, 4)}});
    set.step(60);
    CHECK(set.body(0).angular_velocity.z == Approx(4).epsilon(1e-4));
    Scene two;
    two.gravity = vec3(0);
    two.bodies.push_back({.shape = Box{vec3(0.3f, 0.1f, 0.1f)}});
    two.bodies.push_back({.shape = Box{vec3(0.2f, 0.1f, 0.3f)}, .position = {0.6f, 0, 0}});
    two.joints.push_back(
        joint_at(two, Hinge{{.motor = Motor{.speed = 5, .max_force = 4}, .armature = 1}}, 0, 1, {0.35f, 0, 0}, {0, 1, 0}));
    World pair(two);
    pair.step(60);
    const Statistics after = pair.statistics();
    for (int k = 0; k < 3; ++k) {
        CHECK(std::abs(after.momentum[k]) < 2e-3);
        CHECK(std::abs(after.angular_momentum[k]) < 2e-3);
    }
    CHECK(pair.body(1).angular_velocity.y - pair.body(0).angular_velocity.y > 0.1f);
}

TEST_CASE("an arm with a rotor that strikes a box gains no energy, and ends as if a flywheel turned with it") {
    for (const float ratio : {10.0f, 100.0f, 1000.0f}) {
        const auto struck = [&](bool flywheel) {
            Scene scene;
            scene.gravity = vec3(0);
            scene.bodies.push_back({.shape = Box{{0.5f, 0.05f, 0.05f}}, .position = {0.5f, 0, 0}, .density = 100});
            scene.bodies.push_back({.shape = Box{vec3(0.1f)}, .position = {0.8f, 0.4f, 0}, .density = 125});
            for (Body& body : scene.bodies) body.friction = 0.3f;
            scene.bodies[0].velocity = {0, 1.5f, 0};
            scene.bodies[0].angular_velocity = {0, 0, 3};
            const float inertia = ratio / 3;
            scene.joints.push_back(
                joint_at(scene, Hinge{{.armature = flywheel ? 0 : inertia}}, the_world, 0, vec3(0), {0, 0, 1}));
            if (flywheel) {
                Body wheel{.shape = Sphere{0.1f}, .angular_velocity = {0, 0, 3}};
                wheel.inertial = Inertial{.mass = 10, .inertia = vec3(inertia)};
                wheel.filter = Filter{1, 0, 0};
                scene.bodies.push_back(wheel);
                scene.joints.push_back(joint_at(scene, Fixed{}, 2, 0, vec3(0)));
            }
            World world(scene, {.sleeping = false});
            const double before = energy(world);
            double greatest = 0;
            for (int n = 0; n < 120; ++n) {
                world.step();
                greatest = std::max(greatest, energy(world));
            }
            CHECK(greatest < 1.01 * before);
            return world.body(1).velocity.y;
        };
        INFO("rotor of " << ratio << " times the arm's inertia");
        const float with_flywheel = struck(true), with_rotor = struck(false);
        CHECK(with_rotor == Approx(with_flywheel).epsilon(0.02));
    }
}

TEST_CASE("an impulse turns the rotor of an axis, too") {
    World world(slider({.armature = 400}, 2));
    world.step(3);
    world.apply_impulse(0, vec3(40.2f, 0, 0));
    world.step(3);
    CHECK(world.body(0).velocity.x == Approx(0.1f).epsilon(1e-3));
    world.set_velocity(0, vec3(2, 0, 0), vec3(0));
    world.step(3);
    CHECK(world.body(0).velocity.x == Approx(2).epsilon(1e-3));
}

TEST_CASE("scene files hold the armature of an axis, and refuse it on one that is locked") {
    const auto read = [](const std::string& axis) {
        return checked(scene_from_json(R"({"bodies": [{"shape": {"sphere": {"radius": 1}}}],
            "joints": [{"kind": {"hinge": {)" +
                                       axis + R"(}}, "b": 0, "anchor": [0, 0, 0]}]})")
                           .scene);
    };
    const Scene scene = read(R"("armature": 0.25)");
    CHECK(std::get<Hinge>(scene.joints[0].kind).turn.armature == 0.25f);
    CHECK(scene_to_json(scene_from_json(scene_to_json(scene)).scene) == scene_to_json(scene));
    CHECK_THROWS_WITH(read(R"("armature": 0.25, "locked": true)"), Catch::Contains("a locked axis has no"));
    CHECK_THROWS_WITH(read(R"("armature": -1)"), Catch::Contains("/joints/0/kind/hinge/armature"));
}
