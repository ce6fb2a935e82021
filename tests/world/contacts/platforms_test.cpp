// What lies on a kinematic platform goes with it: speeding up, swinging, rising, turning and tipping; and how a velocity that is
// set changes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "compute/tables/state.h"
#include "compute/world.h"

using namespace scree;

namespace {

struct Ride {
    float rate = 60;
    int substeps = 12;
    float half = 0.2f;    // of the box that rides, m
    vec3 place{0};        // of the box on the platform, m
    bool by_bulk = true;  // set_bodies, else set_velocity
    double seconds = 2;
};
struct Motions {
    vec3 velocity{0}, angular_velocity{0};
};

// How far the box ends from where it lay on the platform, m.
double slip_on(const Ride& ride, const std::function<Motions(double)>& motion) {
    Scene scene;
    Body platform{.motion = Motion::kinematic, .shape = Box{vec3(30, 0.25f, 30)}, .position = {0, -0.25f, 0}};
    platform.friction = 0.5f;
    Body box{.shape = Box{vec3(ride.half)}, .position = ride.place + vec3(0, ride.half, 0)};
    box.friction = 0.5f;
    scene.bodies = {platform, box};
    Settings settings;
    settings.sleeping = false;
    settings.rate = ride.rate;
    settings.substeps = ride.substeps;
    World world(scene, settings, 1);
    world.step(static_cast<int>(ride.rate / 2));
    const auto place = [&world] {
        const BodyState below = world.body(0), above = world.body(1);
        const vec3 way = physics::rotate_back(below.orientation, above.position - below.position);
        return vec3(way.x, 0, way.z);
    };
    const vec3 start = place();
    for (int k = 1; k <= static_cast<int>(ride.seconds * static_cast<double>(ride.rate)); ++k) {
        const Motions now = motion(k / static_cast<double>(ride.rate));
        if (ride.by_bulk)
            world.set_bodies(
                std::vector{BodyChange{.body = 0, .velocity = now.velocity, .angular_velocity = now.angular_velocity}});
        else
            world.set_velocity(0, now.velocity, now.angular_velocity);
        world.step();
    }
    return static_cast<double>(glm::length(place() - start));
}

Motions along(double speed, double rise = 0) {
    return {.velocity = vec3(static_cast<float>(speed), static_cast<float>(rise), 0)};
}

}  // namespace

TEST_CASE("a box on a platform that speeds up with less than friction bears stays where it lies") {
    for (const double a : {1.0, 2.0, 4.0})
        for (const Ride& ride : {Ride{}, Ride{.rate = 30}, Ride{.rate = 120}, Ride{.substeps = 4}, Ride{.substeps = 16},
                                 Ride{.half = 0.05f}, Ride{.half = 1}, Ride{.by_bulk = false}}) {
            CAPTURE(a, ride.rate, ride.substeps, ride.half, ride.by_bulk);
            // What the anchor of its friction gives (friction.h): 4 a h^2, 0.07 mm at 4 m/s^2 with 8 substeps at 60 Hz.
            const double h = 1 / static_cast<double>(ride.rate) / ride.substeps;
            CHECK(slip_on(ride, [&](double t) { return along(a * t); }) < 5 * a * h * h + 5e-6);
        }
    // With more it slides: mu g t^2 / 2 behind.
    CHECK(slip_on({}, [](double t) { return along(8 * t); }) == Approx((8 - 4.905) * 2).epsilon(0.02));
}

TEST_CASE("a box on a platform that swings or rises and falls creeps by less than half a millimetre in 20 s") {
    const Ride ride{.seconds = 20};
    CHECK(slip_on(ride, [](double t) { return along(2.0 / 3 * std::sin(3 * t)); }) < 5e-4);
    CHECK(slip_on(ride, [](double t) { return along(0, 0.8 * 9.81 / 6 * std::sin(6 * t)); }) < 5e-4);
}

TEST_CASE("a kinematic body takes on a velocity over one step, and moves by the mean of both") {
    const float dt = 1.0f / 60;
    for (const int substeps : {1, 4, 8}) {
        CAPTURE(substeps);
        Scene scene;
        scene.bodies.push_back({.motion = Motion::kinematic, .shape = Box{}});
        Settings settings;
        settings.substeps = substeps;
        World world(scene, settings, 1);
        const float share = 0.5f + 0.5f / static_cast<float>(substeps);  // of the change, in the mean of the substeps
        world.set_velocity(0, vec3(3, 0, 0), vec3(0));
        world.step();
        CHECK(world.body(0).velocity == vec3(3, 0, 0));
        CHECK(world.body(0).position.x == Approx(3 * dt * share).epsilon(1e-5));
        world.step();
        CHECK(world.body(0).position.x == Approx(3 * dt * (share + 1)).epsilon(1e-5));
        // Of several changes before a step the last counts, from what it was.
        world.set_bodies(std::vector{BodyChange{.body = 0, .velocity = vec3(0, 9, 0)}});
        CHECK(world.body(0).velocity == vec3(0, 9, 0));
        world.set_velocity(0, vec3(0), vec3(0));
        const std::vector<std::byte> saved = world.save();
        world.step();
        const BodyState stopped = world.body(0);
        CHECK(stopped.velocity == vec3(0));
        CHECK(stopped.position.x == Approx(3 * dt * (share + 1 + (1 - share))).epsilon(1e-5));
        CHECK(stopped.position.y == 0);
        World other(scene, settings, 2);
        other.restore(saved);
        other.step();
        CHECK(other.state_hash() == world.state_hash());
        world.step();
        CHECK(world.body(0).position == stopped.position);
        // Put elsewhere it has its velocity at once.
        world.set_bodies(std::vector{BodyChange{.body = 0, .position = vec3(0), .velocity = vec3(6, 0, 0)}});
        world.step();
        CHECK(world.body(0).position.x == Approx(6 * dt).epsilon(1e-5));
        // One that turns back so that its mean is 0 is not taken for one at rest.
        const float back = -6 * (1 - share) / share;
        world.set_velocity(0, vec3(back, 0, 0), vec3(0));
        world.step();
        CHECK(world.body(0).velocity.x == back);
    }
}

TEST_CASE("a bat strikes with its velocity, and a plate that starts and stops carries all along") {
    Scene scene;
    scene.gravity = vec3(0);
    Body ball{.shape = Sphere{0.1f}, .position = {0.5f, 0, 0}};
    ball.restitution = 1;
    scene.bodies = {{.motion = Motion::kinematic, .shape = Box{vec3(0.1f, 1, 1)}, .position = {-0.5f, 0, 0}}, ball};
    World world(scene, {}, 1);
    world.set_velocity(0, vec3(5, 0, 0), vec3(0));
    world.step(30);
    CHECK(world.body(1).velocity.x == Approx(10).epsilon(0.01));
    for (const float speed : {5.0f, 30.0f, 100.0f})
        for (int phase = 0; phase < 4; ++phase) {
            CAPTURE(speed, phase);
            Scene lying;
            lying.gravity = vec3(0);
            const float gap = 0.002f + speed / 60 * 0.25f * static_cast<float>(phase);
            lying.bodies = {{.motion = Motion::kinematic, .shape = Box{vec3(0.05f, 1, 1)}, .position = {-0.15f - gap, 0, 0}},
                            {.shape = Sphere{0.1f}}};
            World plate(lying, {}, 1);
            plate.set_velocity(0, vec3(speed, 0, 0), vec3(0));
            plate.step();
            plate.set_velocity(0, vec3(0), vec3(0));
            plate.step(4);
            CHECK(plate.body(1).position.x > plate.body(0).position.x + 0.1f);
        }
}

// A frozen contact would lag behind the turn: 130 mm on the turning platform, 27 on the one that tips, in 20 s.
TEST_CASE("a box on a platform that turns or tips stays where it lies") {
    const Ride ride{.place = vec3(1, 0, 0), .seconds = 20};
    const auto about = [](vec3 axis, double spin) { return Motions{.angular_velocity = axis * static_cast<float>(spin)}; };
    for (const double spin : {0.2, 1.0, 1.8})
        CHECK(slip_on(ride, [&](double t) { return about({0, 1, 0}, spin * std::min(1.0, t / 2)); }) < 0.0005);
    CHECK(slip_on(ride, [&](double t) { return about({0, 1, 0}, std::sin(2 * t)); }) < 0.0005);
    for (const double spin : {0.1, 0.3})
        CHECK(slip_on(ride, [&](double t) { return about({0, 0, 1}, spin * std::sin(2 * t)); }) < 0.0005);
}
