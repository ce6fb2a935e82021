// Sleep: resting bodies fall asleep and keep every bit of their state.
#include <catch2/catch.hpp>
#include <vector>

#include "tests/world/sleepers.h"

using namespace scree;

TEST_CASE("a stack falls asleep within a second and then keeps every bit of its poses") {
    World world(stack(5), {}, 1);
    world.step(60);
    REQUIRE(world.statistics().asleep == 5);
    REQUIRE(world.statistics().manifolds == 5);
    REQUIRE(world.statistics().points == 20);
    const std::vector<BodyState> before = world.bodies();
    const std::uint64_t hash = world.state_hash();
    world.step(300);
    REQUIRE(world.state_hash() == hash);
    REQUIRE(world.statistics().points == 20);
    for (std::size_t i = 1; i <= 5; ++i) {
        REQUIRE(same_pose(world.bodies()[i], before[i]));
        REQUIRE(world.bodies()[i].velocity == vec3(0));
        REQUIRE(world.bodies()[i].angular_velocity == vec3(0));
    }
}

TEST_CASE("a stack that is woken lies as it lay") {
    World world(stack(5), {}, 1);
    require_sleep(world, 5);
    const std::vector<BodyState> before = world.bodies();
    world.wake_all();
    world.step();
    REQUIRE(world.statistics().asleep == 0);
    REQUIRE(world.statistics().max_speed < 1e-3);
    world.step(60);
    REQUIRE(world.statistics().asleep == 5);
    for (std::size_t i = 1; i <= 5; ++i) REQUIRE(glm::length(world.bodies()[i].position - before[i].position) < 1e-4f);
}

TEST_CASE("only what the user acts on wakes, and each call wakes") {
    Scene scene;
    scene.bodies = {ground()};
    for (int i = 0; i < 8; ++i) scene.bodies.push_back(at(Box{}, vec3(3 * static_cast<float>(i), 0.5f, 0)));
    World world(scene, {}, 1);
    require_sleep(world, 8);
    world.wake(1);
    world.apply_force(2, vec3(1e-3f, 0, 0));
    world.apply_torque(3, vec3(0, 1e-3f, 0));
    world.apply_impulse(4, vec3(1e-3f, 0, 0));
    world.apply_angular_impulse(5, vec3(0, 1e-3f, 0));
    world.set_velocity(6, vec3(0), vec3(0));
    world.step();
    for (std::size_t i = 1; i <= 8; ++i) {
        CAPTURE(i);
        REQUIRE(asleep(world, i) == (i > 6));
    }
    require_sleep(world, 8);
    REQUIRE_THROWS_AS(world.wake(0), std::invalid_argument);
    REQUIRE_THROWS_AS(world.wake(9), std::out_of_range);
}

TEST_CASE("a force that holds keeps a body awake though it stays") {
    World world(stack(1), {}, 1);
    for (int i = 0; i < 120; ++i) {
        world.apply_force(1, vec3(1, 0, 0));
        world.step();
        REQUIRE_FALSE(asleep(world, 1));
    }
    require_sleep(world, 1);
}

TEST_CASE("sleeping can be forbidden from the start and while a world runs") {
    Settings awake;
    awake.sleeping = false;
    World never(stack(3), awake, 1);
    never.step(200);
    REQUIRE(never.statistics().asleep == 0);

    World world(stack(3), {}, 1);
    require_sleep(world, 3);
    world.set_sleeping(false);
    REQUIRE_FALSE(world.settings().sleeping);
    world.step();
    REQUIRE(world.statistics().asleep == 0);
    world.step(120);
    REQUIRE(world.statistics().asleep == 0);
    world.set_sleeping(true);
    world.step(10);
    REQUIRE(world.statistics().asleep == 0);  // the count of still steps restarts
    require_sleep(world, 3, 60);
}

TEST_CASE("no body sleeps in the air, however slow it is") {
    Scene scene;
    scene.gravity = vec3(0, -0.05f, 0);
    scene.bodies = {ground(), at(Box{}, vec3(0, 3, 0)), at(Sphere{}, vec3(5, 3, 0))};
    scene.bodies[1].velocity = vec3(0, 0.04f, 0);  // below the sleep speed for 1.6 s
    scene.bodies[2].gravity_scale = 0;             // hovers
    scene.bodies[2].velocity = vec3(0.001f, 0, 0);
    World world(scene, {}, 1);
    for (int i = 0; i < 300; ++i) {
        world.step();
        REQUIRE(world.statistics().asleep == 0);
    }
    REQUIRE(place(world, 1).y < 2.7f);
    REQUIRE(place(world, 2).x == Approx(5.005f));
}

TEST_CASE("a swing does not sleep where it turns") {
    Scene scene;
    scene.bodies = {ground(), at(Capsule{0.1f, 0.5f}, vec3(0, 2, 0), Motion::fixed), at(Sphere{0.4f}, vec3(0, 0.4f, 0))};
    scene.bodies[2].velocity = vec3(0, 3, 0);
    World world(scene, {}, 1);
    while (world.bodies()[2].velocity.y > 0 || world.steps() < 2) {
        world.step();
        REQUIRE_FALSE(asleep(world, 2));
    }
}

TEST_CASE("settings of sleep out of their range are refused") {
    Settings settings;
    settings.sleep_speed = 0;
    REQUIRE_THROWS_WITH(World(stack(1), settings, 1), Catch::Contains("sleep_speed"));
    settings.sleep_speed = 0.05f;
    settings.sleep_time = 5;
    REQUIRE_THROWS_WITH(World(stack(1), settings, 1), Catch::Contains("sleep_time"));
}
