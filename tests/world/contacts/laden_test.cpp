// Light bodies under heavy ones: how far their contacts give way, that weights are exact, and that what moves under a load
// accelerates as its mass and the load's.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "compute/world.h"
#include "tests/world/laden.h"

using namespace scree;

namespace {

Settings awake(int substeps = Settings{}.substeps) {
    Settings settings;
    settings.sleeping = false;
    settings.substeps = substeps;
    return settings;
}
float mass_of(const Body& body) {
    return static_cast<float>(mass_properties(body).mass);
}

// m, sideways.
float greatest_drift(const World& world) {
    float greatest = 0;
    const std::vector<BodyState> bodies = world.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const vec3 way = bodies[i].position - world.scene().bodies[i].position;
        greatest = std::max(greatest, std::hypot(way.x, way.z));
    }
    return greatest;
}
float sinking_of_last(const World& world) {
    return world.scene().bodies.back().position.y - world.bodies().back().position.y;
}

}  // namespace

// A soft contact gives way until the bias of its spring balances the leak of its impulse (contact_solver.h).
TEST_CASE("a contact under a load gives way in proportion to the load and to the square of the substep", "[laden]") {
    for (const float ratio : {10.0f, 100.0f, 300.0f})
        for (const int substeps : {8, 12, 24}) {
            World world(tests::laden_column(2, 1, 1, ratio), awake(substeps), 1);
            world.step(600);
            const float h = 1.0f / (60.0f * static_cast<float>(substeps));
            // Box on box, and both on the ground, whose mass has no end.
            const float expected = 3.46f * (1 + ratio) * 9.81f * h * h;
            INFO("ratio " << ratio << ", " << substeps << " substeps: " << sinking_of_last(world) / expected);
            CHECK(sinking_of_last(world) == Approx(expected).epsilon(0.1));
        }
}

TEST_CASE("columns of ten boxes placed with 2 mm and 0.3 degrees of error stand under a hundred times their mass", "[laden]") {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        World world(tests::laden_column(10, 1, 1, 100, seed), awake(), 1);
        world.step(1200);
        INFO("seed " << seed);
        CHECK(greatest_drift(world) < 0.02f);
        CHECK(sinking_of_last(world) < 0.08f);
    }
}

TEST_CASE("laden bodies press with their own weight", "[laden]") {
    const Scene scene = tests::laden_column(4, 1, 1, 200);
    World world(scene, awake(), 1);
    world.step(900);
    double weight = 0, force = 0;
    for (const Body& body : scene.bodies)
        if (body.motion == Motion::dynamic) weight += 9.81 * mass_properties(body).mass;
    constexpr int steps = 60;  // in the mean of a second
    for (int step = 0; step < steps; ++step) {
        world.step();
        for (const ContactState& contact : world.contacts())
            if (contact.a == 0)
                for (std::uint32_t k = 0; k < contact.count; ++k) force += static_cast<double>(contact.points[k].force) / steps;
    }
    CHECK(force == Approx(weight).epsilon(2e-5));
}

// Pulled over ice with a force for 1 m/s^2.
TEST_CASE("what moves under a load accelerates as its mass and the load's", "[laden]") {
    for (const float ratio : {1.0f, 10.0f, 100.0f}) {
        Scene scene = tests::laden_column(2, 1, 1, ratio);
        scene.bodies[0].friction = 0;
        scene.bodies[1].friction = scene.bodies[2].friction = 0.9f;
        World world(scene, awake(), 1);
        world.step(180);
        const float force = mass_of(scene.bodies[1]) * (1 + ratio);
        for (int step = 0; step < 120; ++step) {
            world.apply_force(1, {force, 0, 0});
            world.step();
        }
        INFO("ratio " << ratio);
        CHECK(world.bodies()[2].velocity.x == Approx(2).epsilon(1e-3));
    }
}

// A box as heavy as the load, which a force holds and then lifts with 1 m/s^2.
TEST_CASE("what a force lifts under a load accelerates at once", "[laden]") {
    struct Lift {
        int count;
        float ratio;
    };
    for (const Lift& lift : {Lift{2, 10}, Lift{5, 100}}) {
        Scene scene = tests::laden_column(lift.count, 1, 1, lift.ratio);
        scene.bodies[0] = {.name = "lifted", .shape = Box{vec3(0.5f)}, .position = {0, -0.5f, 0}, .density = 100 * lift.ratio};
        World world(scene, awake(), 1);
        float mass = 0;
        for (const Body& body : scene.bodies) mass += mass_of(body);
        const auto push = [&](float acceleration, int steps) {
            for (int step = 0; step < steps; ++step) {
                world.apply_force(0, {0, mass * (9.81f + acceleration), 0});
                world.step();
            }
            return world.bodies().back().velocity.y;
        };
        const float before = push(0, 300), after = push(1, 60), later = push(1, 60);
        INFO(lift.count << " boxes, ratio " << lift.ratio << ": " << before << ", " << after << ", " << later);
        CHECK(after - before == Approx(1).margin(0.02));
        CHECK(later - after == Approx(1).margin(0.02));
    }
}

TEST_CASE("a load whose support is taken away falls at once", "[laden]") {
    for (const float ratio : {10.0f, 100.0f}) {
        Scene scene = tests::laden_column(2, 1, 1, ratio);
        for (Body& body : scene.bodies) body.position.y += 100;
        scene.bodies[0] = {.name = "support", .motion = Motion::fixed, .shape = Box{{2, 0.5f, 2}}, .position = {0, 99.5f, 0}};
        World world(scene, awake(), 1);
        world.step(600);
        world.remove_body(0);
        world.step(60);
        INFO("ratio " << ratio);
        CHECK(world.bodies()[2].velocity.y == Approx(-9.81f).margin(0.03));
    }
}

TEST_CASE("a mass that is changed, and a new body at an old index, count from the next step on", "[laden]") {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies.push_back({.name = "box", .shape = Box{vec3(0.5f)}});
    World world(scene, awake(), 1);
    world.step(2);
    world.set_mass(0, 1);
    world.apply_impulse(0, {1, 0, 0});
    world.step();
    CHECK(world.bodies()[0].velocity.x == Approx(1).epsilon(1e-5));
    world.set_mass(0, 1000);
    world.step(2);
    world.remove_body(0);
    world.step();
    Body light{.name = "light", .shape = Box{vec3(0.5f)}};
    light.density = 1;
    REQUIRE(world.add_body(light) == 0);
    world.apply_impulse(0, {1, 0, 0});
    world.step();
    CHECK(world.bodies()[0].velocity.x == Approx(1).epsilon(1e-5));
}

TEST_CASE("an impulse on what bears a load changes momentum by as much", "[laden]") {
    Scene scene = tests::laden_column(2, 1, 1, 100);
    scene.bodies[0].friction = 0;
    scene.bodies[1].friction = scene.bodies[2].friction = 0.9f;
    World world(scene, awake(), 1);
    world.step(600);
    const float light = mass_of(scene.bodies[1]);
    const std::vector<BodyState> before = world.bodies();
    const float impulse = 0.5f * light;
    world.apply_impulse(1, {impulse, 0, 0});
    world.step(120);
    const std::vector<BodyState> bodies = world.bodies();
    const float gained =
        light * (bodies[1].velocity.x - before[1].velocity.x) + 100 * light * (bodies[2].velocity.x - before[2].velocity.x);
    CHECK(gained == Approx(impulse).epsilon(0.01));
}
