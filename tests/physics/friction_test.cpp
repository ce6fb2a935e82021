// Friction and rolling resistance of contacts whose effective mass a float hardly holds.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "compute/cpu/reference_runner.h"
#include "compute/world.h"
#include "shaders/physics/contact/contact_preparation.h"
#include "tests/world/heaps.h"

using namespace scree;
using namespace scree::physics;

namespace {

Parameters in_a_substep() {
    Parameters p{};
    p.h = 1.0f / 720;
    p.dt = 1.0f / 60;
    p.inverse_h = 720;
    p.bias_rate = 30;
    p.mass_scale = 0.9f;
    p.impulse_scale = 0.1f;
    p.inverse_relaxation = 1 / 1.5f;
    p.max_spin = 500;
    return p;
}

// A rod: it turns `ratio` times as easily about its axis as across.
Mass rod(float inverse_mass, float inverse_inertia, float ratio, vec4 orientation) {
    BodyProperties properties{};
    properties.inverse_mass = inverse_mass;
    properties.inverse_inertia = vec3(inverse_inertia, inverse_inertia * ratio, inverse_inertia);
    Mass mass = mass_in_world(properties, orientation);
    mass.split = 3;
    return mass;
}

struct Sliding {
    Constraint c;
    SolveResult pass;
    Mass a, b;
    float normal;
};
Sliding sliding(tests::Noise& noise, float ratio, float far) {
    Sliding made;
    Contact contact{};
    contact.count = 1;
    contact.normal = unit3(noise.vector(), vec3(0, 1, 0));
    made.c = idle_constraint(contact);
    made.c.friction = 0.6f;
    made.c.rolling_resistance = 0.02f;
    made.c.centre = noise.vector() * far;
    made.pass.impulse = no_impulse(noise.vector());
    made.pass.impulse.friction = noise.vector();
    made.pass.impulse.rolling = noise.vector();
    made.pass.pair_velocity.a.linear = noise.vector() * 100.0f;
    made.pass.pair_velocity.a.angular = noise.vector() * 100.0f;
    made.pass.pair_velocity.b.linear = noise.vector() * 100.0f;
    made.pass.pair_velocity.b.angular = noise.vector() * 100.0f;
    made.pass.wrench.push = made.pass.wrench.moment = vec3(0);
    const auto turn = [&] { return unit_quaternion(vec4(noise(), noise(), noise(), noise())); };
    made.a = rod(1.0f + 0.5f * noise(), 1.0f + 0.5f * noise(), ratio, turn());
    made.b = Mass{};
    made.b.split = 1;
    made.normal = 5 + 4 * noise();
    return made;
}

}  // namespace

TEST_CASE("friction and rolling resistance are finite and within their limits, however slender a body or far its contact") {
    tests::Noise noise(11);
    int lost = 0;
    for (const float ratio : {1.0f, 1e3f, 1e5f, 1e7f, 1e9f})
        for (const float far : {1.0f, 1e3f, 1e5f})
            for (int i = 0; i < 4000; ++i) {
                CAPTURE(ratio, far, i);
                const Sliding s = sliding(noise, ratio, far);
                const SolveResult after =
                    solve_patch_friction(s.c, s.pass, s.normal, s.a, s.b, s.a, s.b, i % 2 == 0, in_a_substep());
                const float friction = glm::length(after.impulse.friction), rolling = glm::length(after.impulse.rolling);
                REQUIRE(friction <= 0.6f * s.normal * 1.001f);
                REQUIRE(rolling <= 0.02f * s.normal * 1.001f);
                REQUIRE(std::isfinite(glm::length(after.wrench.push) + glm::length(after.wrench.moment)));
                const LeverArms r = lever_arms(s.c, s.c.centre, s.pass.impulse.center_offset);
                const FrictionBlock k = friction_block(r, s.c.normal, s.a, s.b);
                lost += k.k11 * k.k22 - k.k12 * k.k12 <= 0;
            }
    CHECK(lost > 100);  // determinants that rounding took: the test is about these
}

TEST_CASE("spinning resistance on an arm of many radii stops a spin, and does not set a ball in motion") {
    for (const float resistance : {1.0f, 100.0f, 1e3f, 1e5f})
        for (const float spin : {0.0f, 1.0f, 30.0f, 100.0f})
            for (const int lanes : {1, 16}) {
                CAPTURE(resistance, spin, lanes);
                Scene scene;
                scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
                Body ball{.shape = Sphere{0.3f}, .position = {0, 0.3f, 0}, .velocity = {0.5f, 0, 0.5f}};
                ball.angular_velocity = {0, spin, 3};
                set_material(ball, {.friction = 0.5f, .spinning_resistance = resistance});
                scene.bodies.push_back(ball);
                World world(scene, {}, std::make_unique<ReferenceRunner>(1, lanes));
                for (int step = 0; step < 60; ++step) {
                    world.step();
                    const BodyState now = world.body(1);
                    REQUIRE(glm::length(now.velocity) <= 0.75f);
                    REQUIRE(std::abs(now.angular_velocity.y) <= spin + 0.01f);
                }
                if (resistance > 10) CHECK(std::abs(world.body(1).angular_velocity.y) < 0.01f);
            }
}

TEST_CASE("a ball that rolls goes straight, however fast it spins about the normal") {
    for (const float radius : {0.02f, 0.5f})
        for (const float spin : {0.0f, 30.0f, 300.0f}) {
            CAPTURE(radius, spin);
            Scene scene;
            scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
            Body ball{.shape = Sphere{radius}, .position = {0, radius, 0}, .velocity = {1, 0, 0}};
            ball.angular_velocity = {0, spin, -1 / radius};
            scene.bodies.push_back(ball);
            World world(scene, {}, 1);
            world.step(60);
            CHECK(std::abs(world.body(1).position.z) < 1e-4f);
            CHECK(world.body(1).position.x == Approx(1).epsilon(0.001));
        }
}

TEST_CASE("a ball that rolls on a turntable runs in circles, at two sevenths of its rate") {
    for (const float rate : {0.5f, 2.0f}) {
        CAPTURE(rate);
        const float radius = 0.2f, way_out = 3;
        Scene scene;
        Body table{.motion = Motion::kinematic, .shape = Box{{20, 0.5f, 20}}, .position = {0, -0.5f, 0}};
        table.angular_velocity = {0, rate, 0};
        Body ball{.shape = Sphere{radius}, .position = {way_out, radius, 0}, .velocity = {1, 0, 0}};
        ball.angular_velocity = {rate * way_out / radius, 0, -1 / radius};
        scene.bodies = {table, ball};
        World world(scene, {}, 1);
        world.step(60 * 5);
        const vec3 now = world.body(1).velocity;
        const double angle = 2.0 / 7 * static_cast<double>(rate) * 5;
        CHECK(now.x == Approx(std::cos(angle)).margin(0.03));
        CHECK(now.z == Approx(-std::sin(angle)).margin(0.03));
    }
}
