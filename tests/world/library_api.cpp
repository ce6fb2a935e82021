// The public API, compute/world.h: forces and impulses follow mechanics, errors are named.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "compute/world.h"

namespace {

using scree::vec3;
using scree::World;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

scree::Body body(scree::Shape shape, vec3 position, scree::Motion motion = scree::Motion::dynamic) {
    scree::Body made;
    made.shape = shape;
    made.position = position;
    made.motion = motion;
    return made;
}

// A box of 1 x 2 x 3 m far from a ball, without gravity.
scree::Scene free_space() {
    scree::Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {body(scree::Box{vec3(0.5f, 1, 1.5f)}, vec3(0)), body(scree::Sphere{0.5f}, vec3(100, 0, 0))};
    return scene;
}

// Within the rounding of a step: a few units in the last place.
void require_near(vec3 value, vec3 expected, float tolerance) {
    INFO("is " << value.x << " " << value.y << " " << value.z << ", expected " << expected.x << " " << expected.y << " "
               << expected.z);
    REQUIRE(std::abs(value.x - expected.x) <= tolerance);
    REQUIRE(std::abs(value.y - expected.y) <= tolerance);
    REQUIRE(std::abs(value.z - expected.z) <= tolerance);
}

}  // namespace

TEST_CASE("a force accelerates a body by F/m while it is applied, and only then", "[world]") {
    World world(free_space());
    const float mass = scree::mass_properties(world.scene().bodies[0].shape, 1000).mass;
    REQUIRE(mass == Approx(6000));
    const vec3 force = vec3(6000, -12000, 3000);
    for (int i = 0; i < 60; ++i) {
        world.apply_force(0, force * 0.25f);
        world.apply_force(0, force * 0.75f);
        world.step();
    }
    require_near(world.bodies()[0].velocity, vec3(1, -2, 0.5f), 2e-5f);
    world.step(60);
    require_near(world.bodies()[0].velocity, vec3(1, -2, 0.5f), 2e-5f);
    // Semi-implicit Euler in substeps of h: t^2/2 becomes t (t + h) / 2.
    const float half = 0.5f * (1 + 1.0f / 720);
    require_near(world.bodies()[0].position, vec3(1, -2, 0.5f) * (half + 1), 1e-4f);
    require_near(world.bodies()[1].velocity, vec3(0), 0);
}

TEST_CASE("an impulse changes the velocity by J/m at once", "[world]") {
    World world(free_space());
    world.apply_impulse(0, vec3(6000, 0, 0));
    world.apply_impulse(0, vec3(0, 12000, 0));
    world.step();
    require_near(world.bodies()[0].velocity, vec3(1, 2, 0), 1e-6f);
    require_near(world.bodies()[0].position, vec3(1, 2, 0) / 60.0f, 1e-6f);
}

TEST_CASE("torque and angular impulse turn a body by its inertia", "[world]") {
    World world(free_space());
    // About z a box of 6000 kg, 1 m by 2 m, has 6000/12 (1 + 4) = 2500 kg m^2.
    world.apply_angular_impulse(0, vec3(0, 0, 2500));
    world.step();
    require_near(world.bodies()[0].angular_velocity, vec3(0, 0, 1), 1e-5f);
    for (int i = 0; i < 60; ++i) {
        world.apply_torque(0, vec3(0, 0, 5000));
        world.step();
    }
    require_near(world.bodies()[0].angular_velocity, vec3(0, 0, 3), 1e-4f);
    require_near(world.bodies()[0].velocity, vec3(0), 0);
}

TEST_CASE("an offset gives a force and an impulse their lever", "[world]") {
    World world(free_space());
    world.apply_impulse(0, vec3(0, 2500, 0), vec3(0.5f, 0, 0));
    world.step();
    require_near(world.bodies()[0].velocity, vec3(0, 2500.0f / 6000, 0), 1e-6f);
    require_near(world.bodies()[0].angular_velocity, vec3(0, 0, 0.5f), 1e-5f);

    World other(free_space());
    other.apply_force(0, vec3(0, 2500 * 60, 0), vec3(0.5f, 0, 0));
    other.step();
    require_near(other.bodies()[0].angular_velocity, vec3(0, 0, 0.5f), 1e-4f);
}

TEST_CASE("a body held up by its weight hovers", "[world]") {
    scree::Scene scene = free_space();
    scene.gravity = vec3(0, -9.81f, 0);
    World world(scene);
    for (int i = 0; i < 300; ++i) {
        world.apply_force(0, vec3(0, 9.81f * 6000, 0));
        world.step();
    }
    require_near(world.bodies()[0].position, vec3(0), 1e-4f);
    REQUIRE(world.bodies()[1].position.y < -100);
}

TEST_CASE("a velocity that is set is the velocity of the step", "[world]") {
    World world(free_space());
    world.set_velocity(0, vec3(3, 0, 0), vec3(0, 2, 0));
    world.step(30);
    require_near(world.bodies()[0].position, vec3(1.5f, 0, 0), 1e-4f);
    require_near(world.bodies()[0].velocity, vec3(3, 0, 0), 1e-5f);
    require_near(world.bodies()[0].angular_velocity, vec3(0, 2, 0), 1e-4f);
}

TEST_CASE("a kinematic body keeps its velocity and pushes what is in its way", "[world]") {
    scree::Scene scene;
    scene.bodies = {body(scree::Plane{}, vec3(0), scree::Motion::fixed),
                    body(scree::Box{vec3(0.5f)}, vec3(0, 0.5f, 0), scree::Motion::kinematic),
                    body(scree::Box{vec3(0.5f)}, vec3(1.5f, 0.5f, 0))};
    scene.bodies[1].velocity = vec3(1, 0, 0);
    World world(scene);
    world.step(120);
    require_near(world.bodies()[1].position, vec3(2, 0.5f, 0), 1e-4f);
    require_near(world.bodies()[1].velocity, vec3(1, 0, 0), 0);
    REQUIRE(world.bodies()[2].position.x == Approx(3).margin(0.02));

    world.set_velocity(1, vec3(0, 0, 0), vec3(0));
    world.step(60);
    // It stops evenly within a step: 11/24 of its way in that.
    require_near(world.bodies()[1].position, vec3(2 + 11.0f / 24 / 60, 0.5f, 0), 1e-4f);
    // Stopping distance v^2 / (2 mu g).
    REQUIRE(world.bodies()[2].position.x == Approx(3 + 1 / (2 * 0.6 * 9.81)).margin(0.02));
    REQUIRE_THROWS_AS(world.apply_force(1, vec3(1)), std::invalid_argument);
}

TEST_CASE("a wrong index, a value that is not finite and a body that is not dynamic are refused by name", "[world]") {
    scree::Scene scene = free_space();
    scene.bodies.push_back(body(scree::Plane{vec3(0, 1, 0), -50}, vec3(0), scree::Motion::fixed));
    World world(scene);
    REQUIRE_THROWS_AS(world.apply_force(3, vec3(1)), std::out_of_range);
    REQUIRE_THROWS_AS(world.apply_torque(3, vec3(1)), std::out_of_range);
    REQUIRE_THROWS_AS(world.apply_impulse(17, vec3(1)), std::out_of_range);
    REQUIRE_THROWS_AS(world.apply_angular_impulse(std::numeric_limits<std::size_t>::max(), vec3(1)), std::out_of_range);
    REQUIRE_THROWS_AS(world.set_velocity(3, vec3(1), vec3(1)), std::out_of_range);
    REQUIRE_THROWS_WITH(world.apply_impulse(17, vec3(1)), Catch::Contains("17"));

    REQUIRE_THROWS_AS(world.apply_force(0, vec3(0, not_a_number, 0)), std::invalid_argument);
    REQUIRE_THROWS_AS(world.apply_force(0, vec3(1), vec3(infinity, 0, 0)), std::invalid_argument);
    REQUIRE_THROWS_AS(world.apply_torque(0, vec3(-infinity, 0, 0)), std::invalid_argument);
    REQUIRE_THROWS_AS(world.set_velocity(0, vec3(0), vec3(not_a_number)), std::invalid_argument);

    REQUIRE_THROWS_AS(world.apply_force(2, vec3(1)), std::invalid_argument);
    REQUIRE_THROWS_AS(world.set_velocity(2, vec3(1), vec3(0)), std::invalid_argument);

    // Refused calls have no effect.
    world.step();
    require_near(world.bodies()[0].velocity, vec3(0), 0);
    require_near(world.bodies()[0].angular_velocity, vec3(0), 0);
}

TEST_CASE("no force that floats can hold makes a state that they cannot", "[world]") {
    World world(free_space());
    world.apply_force(0, vec3(3e38f, 0, 0));
    world.apply_force(0, vec3(3e38f, 0, 0));
    world.apply_angular_impulse(1, vec3(3e38f));
    world.step(10);
    REQUIRE(world.statistics().not_finite == 0);
    REQUIRE(world.statistics().max_speed <= 400 * 1.001);
}

TEST_CASE("a scene and settings that make no sense are refused", "[world]") {
    scree::Scene scene = free_space();
    scene.bodies[1].position.x = not_a_number;
    REQUIRE_THROWS_AS(World(scene), scree::SceneError);
    scree::Settings settings;
    settings.substeps = 0;
    REQUIRE_THROWS_AS(World(free_space(), settings), std::invalid_argument);
    settings.substeps = 8;
    settings.rate = not_a_number;
    REQUIRE_THROWS_AS(World(free_space(), settings), std::invalid_argument);
}

TEST_CASE("no step changes nothing, and the hash is of the state alone", "[world]") {
    scree::Scene scene = free_space();
    scene.gravity = vec3(0, -9.81f, 0);
    scene.bodies.push_back(body(scree::Plane{vec3(0, 1, 0), -2}, vec3(0), scree::Motion::fixed));
    World world(scene), other(scene, {}, 1);
    const std::uint64_t start = world.state_hash();
    world.step(0);
    REQUIRE(world.state_hash() == start);
    REQUIRE(world.steps() == 0);
    REQUIRE(other.state_hash() == start);

    world.step(30);
    other.step(10);
    (void)other.state_hash();
    (void)other.statistics();
    other.step(20);
    REQUIRE(world.state_hash() != start);
    REQUIRE(world.state_hash() == world.state_hash());
    REQUIRE(world.state_hash() == other.state_hash());
    REQUIRE(world.steps() == 30);
    REQUIRE(world.time() == Approx(0.5));
}

TEST_CASE("a world can be moved, and one without bodies steps", "[world]") {
    World empty{scree::Scene{}};
    empty.step(3);
    REQUIRE(empty.bodies().empty());
    REQUIRE(empty.statistics().bodies == 0);

    World first(free_space());
    first.apply_impulse(0, vec3(6000, 0, 0));
    World second(std::move(first));
    second.step();
    require_near(second.bodies()[0].velocity, vec3(1, 0, 0), 1e-6f);
}
