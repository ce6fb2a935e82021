// Waking: everything that should move a sleeping body wakes it.
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/cpu/reference_runner.h"
#include "compute/tables/state.h"
#include "shaders/physics/sleep/sleep.h"
#include "tests/world/heaps.h"
#include "tests/world/sleepers.h"

using namespace scree;

TEST_CASE("a row of sleeping balls passes on a blow as it does awake") {
    for (const float restitution : {0.0f, 1.0f}) {
        for (const int row : {2, 5, 10}) {
            for (const float speed : {0.5f, 3.0f}) {
                CAPTURE(restitution, row, speed);
                Scene scene;
                scene.bodies = {ground(0)};
                for (int i = 0; i < row; ++i) scene.bodies.push_back(at(Sphere{}, vec3(static_cast<float>(i), 0.5f, 0)));
                for (Body& body : scene.bodies) body.restitution = restitution;
                Body striker = at(Sphere{}, vec3(-1.5f - speed * 1.2f, 0.5f, 0));
                striker.velocity = vec3(speed, 0, 0);
                striker.friction = 0;
                striker.restitution = restitution;
                scene.bodies.push_back(striker);
                Settings settings;
                settings.restitution_threshold = 0.1f;
                Settings awake = settings;
                awake.sleeping = false;
                World world(scene, settings, 1), other(scene, awake, 1);
                world.step(60);
                other.step(60);
                REQUIRE(world.statistics().asleep == static_cast<std::size_t>(row));
                world.step(30);
                other.step(30);
                const double mass = static_cast<double>(mass_properties(Sphere{}, 1000).mass);
                const double momentum = mass * static_cast<double>(speed);
                // Bodies disturbed by less than a hundredth of the sleep speed stay asleep (sleep.h).
                const double lost = 0.01 * static_cast<double>(settings.sleep_speed * static_cast<float>(row) / speed);
                CHECK(std::abs(world.statistics().momentum[0] / momentum - 1) < 1e-5 + lost);
                for (std::size_t i = 1; i <= static_cast<std::size_t>(row) + 1; ++i) {
                    CAPTURE(i);
                    CHECK(std::abs(world.bodies()[i].velocity.x - other.bodies()[i].velocity.x) < 0.03f * speed);
                }
            }
        }
    }
}

TEST_CASE("a sleeper whose support is drawn away falls, at once or slowly, sideways or down") {
    for (const vec3 velocity : {vec3(6, 0, 0), vec3(0, -3, 0), vec3(2, 0, 0), vec3(0, -0.02f, 0)}) {
        CAPTURE(velocity.x, velocity.y);
        Scene scene;
        scene.bodies = {at(Box{vec3(1, 0.5f, 1)}, vec3(0), Motion::kinematic), at(Box{}, vec3(0, 1, 0)),
                        at(Box{}, vec3(0, 2, 0))};
        scene.bodies[1].friction = 0.05f;
        scene.bodies[0].friction = 0.05f;
        World world(scene, {}, 1);
        require_sleep(world, 2);
        const float top = place(world, 2).y;
        world.set_velocity(0, velocity, vec3(0));
        world.step();
        REQUIRE_FALSE(asleep(world, 1));
        world.step(velocity.y == -0.02f ? 149 : 479);
        if (velocity.y == -0.02f) {
            REQUIRE(place(world, 2).y == Approx(top - 0.05f).margin(2e-3));
        } else {
            REQUIRE(place(world, 2).y < top - 1);
        }
    }
}

TEST_CASE("what lies on a dynamic body wakes when that is struck from under it") {
    Scene scene = stack(3);
    for (Body& body : scene.bodies) body.friction = 0.1f;
    World world(scene, {}, 1);
    require_sleep(world, 3);
    world.set_velocity(1, vec3(12, 0, 0), vec3(0));
    world.step(2);
    REQUIRE_FALSE(asleep(world, 2));
    world.step(90);
    REQUIRE(place(world, 1).x > 3);
    REQUIRE(place(world, 2).y == Approx(0.5f).margin(0.02));
    REQUIRE(place(world, 3).y == Approx(1.5f).margin(0.02));
}

TEST_CASE("a platform that starts takes its load along, and one that stops lets it sleep") {
    Scene scene;
    scene.bodies = {at(Box{vec3(2, 0.5f, 2)}, vec3(0), Motion::kinematic), at(Box{}, vec3(0, 1, 0)), at(Box{}, vec3(0, 2, 0))};
    World world(scene, {}, 1);
    require_sleep(world, 2);
    world.set_velocity(0, vec3(0.5f, 0.25f, 0), vec3(0));
    for (int i = 0; i < 120; ++i) {
        world.step();
        REQUIRE(world.statistics().asleep == 0);  // though slow relative to its support, and later at rest on it
    }
    REQUIRE(place(world, 2).x == Approx(1).margin(0.1));
    REQUIRE(place(world, 2).y == Approx(2.5f).margin(0.02));
    world.set_velocity(0, vec3(0), vec3(0));
    require_sleep(world, 2);
}

TEST_CASE("a weight laid gently on a sleeping see-saw tips it") {
    Scene scene;
    scene.bodies = {ground(), at(Capsule{0.3f, 0.5f}, vec3(0, 0.3f, 0), Motion::fixed),
                    at(Box{vec3(3, 0.1f, 0.5f)}, vec3(0, 0.7f, 0)), at(Box{vec3(0.3f)}, vec3(-2, 1.1f, 0)),
                    at(Box{vec3(0.3f)}, vec3(2, 1.1f, 0))};
    scene.bodies[1].orientation = vec4(std::sqrt(0.5f), 0, 0, std::sqrt(0.5f));
    World world(scene, {}, 1);
    require_sleep(world, 3);

    // The same, with a third weight that floats just above the right end until then.
    scene.bodies.push_back(at(Box{vec3(0.3f)}, vec3(2, 1.71f, 0)));
    scene.bodies.back().gravity_scale = 0;
    World apply_forces(scene, {}, 1);
    require_sleep(apply_forces, 3);
    for (int i = 0; i < 120; ++i) {
        apply_forces.apply_force(5, vec3(0, -0.25f * 216 * 9.81f, 0));  // a quarter of one weight
        apply_forces.step();
    }
    REQUIRE(place(apply_forces, 4).y < 0.7f);
    REQUIRE(place(apply_forces, 3).y > 1.3f);
}

TEST_CASE("a heavy load on a sleeping stack wakes it down to the ground, a light one does not") {
    for (const float density : {1.0f, 4000.0f}) {
        CAPTURE(density);
        Scene scene = stack(4);
        scene.bodies.push_back(at(Box{}, vec3(0, 30, 0)));
        scene.bodies.back().density = density;
        scene.bodies.back().gravity_scale = 0;
        World world(scene, {}, 1);
        require_sleep(world, 4);
        world.set_velocity(5, vec3(0, -0.5f, 0), vec3(0));
        bool woke = false;
        float lowest = 1;
        for (int i = 0; i < 3200; ++i) {
            if (place(world, 5).y < 4.53f) world.apply_force(5, vec3(0, -9.81f * density, 0));
            world.step();
            woke = woke || !asleep(world, 1);
            lowest = std::min(lowest, place(world, 1).y);
        }
        REQUIRE(place(world, 5).y < 4.55f);
        if (density > 1) REQUIRE(woke);
        if (density == 1) REQUIRE_FALSE(woke);
    }
}

TEST_CASE("a load that grows so gently that nothing moves reaches the sleepers under it") {
    Settings never;
    never.sleeping = false;
    World world(stack(3), {}, 1), other(stack(3), never, 1);
    require_sleep(world, 3);
    other.step(static_cast<int>(world.steps()));
    bool woke = false;
    for (int i = 0; i < 240; ++i) {
        for (World* each : {&world, &other}) {
            each->apply_force(3, vec3(0, -1000.0f * 9.81f * std::min(3.0f, 0.025f * static_cast<float>(i)), 0));
            each->step();
        }
        woke = woke || !asleep(world, 1);
    }
    REQUIRE(woke);
    const float sag = 0.5f - place(other, 1).y;
    REQUIRE(sag > 1e-4f);
    REQUIRE(0.5f - place(world, 1).y == Approx(sag).epsilon(0.05));
}

TEST_CASE("a sleeper whose support is gone from one step to the next wakes, and only it") {
    State state(checked(stack(2)), {}, 64, true);
    ReferenceRunner runner(1);
    runner.attach(state);
    const physics::uint sleep_steps = state.fixed().sleep_steps;
    const auto sleeps = [&](std::size_t body) { return physics::is_asleep(state.sleep_states[body], sleep_steps); };
    for (int i = 0; i < 180 && !(sleeps(1) && sleeps(2)); ++i) REQUIRE(runner.step());
    REQUIRE(runner.step());
    REQUIRE(sleeps(2));
    state.poses[1].position.x += 5;
    state.sleep_states[1] = 1;  // awake, but not restless
    REQUIRE(runner.step());
    REQUIRE_FALSE(sleeps(2));
    for (int i = 0; i < 30; ++i) REQUIRE(runner.step());
    REQUIRE(state.poses[2].position.y < 1);
}

TEST_CASE("small sleepers are found by large bodies that come over them") {
    for (const bool giant : {false, true}) {
        CAPTURE(giant);
        Scene scene;
        scene.bodies = {ground()};
        for (int i = 0; i < 100; ++i)
            scene.bodies.push_back(
                at(Box{vec3(0.1f)}, vec3(0.5f * static_cast<float>(i % 10), 0.1f, 0.5f * static_cast<float>(i / 10))));
        // A single one is in the list of large bodies; many have a grid level of their own.
        for (int i = 0; i < (giant ? 1 : 30); ++i)
            scene.bodies.push_back(at(Box{vec3(1)}, vec3(-8 - 2.5f * static_cast<float>(i), 1.02f, 2), Motion::kinematic));
        World world(scene, {}, 1);
        require_sleep(world, 100);
        world.set_velocity(101, vec3(4, 0, 0), vec3(0));
        world.step(240);
        int moved = 0;
        for (int i = 0; i < 100; ++i) {
            const bool in_the_way = std::abs(scene.bodies[static_cast<std::size_t>(i) + 1].position.z - 2) < 1;
            const bool pushed = place(world, static_cast<std::size_t>(i) + 1).x > 4.6f;
            moved += pushed;
            if (in_the_way) REQUIRE(pushed);
        }
        REQUIRE(moved < 60);
        REQUIRE(world.statistics().asleep > 40);
    }
}

TEST_CASE("a heap that sleeps and is struck is the same from tiny buffers and on many threads") {
    Scene scene = tests::heap(100, 2);
    for (Body& body : scene.bodies) body.rolling_resistance = 0.02f;
    Settings tiny;
    tiny.pairs_at_first = 1;
    tiny.contacts_at_first = 1;
    World roomy(scene, {}, 1), cramped(scene, tiny, 1), threaded(scene, {}, 3);
    for (int i = 0; i < 500; ++i) {
        for (World* world : {&roomy, &cramped, &threaded}) {
            if (i == 400) world->set_velocity(7, vec3(0, 20, 0), vec3(3, 0, 0));
            world->step();
        }
        REQUIRE(cramped.state_hash() == roomy.state_hash());
        REQUIRE(threaded.state_hash() == roomy.state_hash());
        if (i == 399) REQUIRE(roomy.statistics().asleep > 80);
    }
    REQUIRE(cramped.buffer_growths() > 0);
}

TEST_CASE("a sleeper wakes and gives way to what is added into it, whatever that is") {
    const auto wall = [](vec3 at_place) { return at(Box{vec3(0.25f)}, at_place, Motion::fixed); };
    Compound two;
    two.parts = {{.shape = Box{vec3(0.25f)}}, {.shape = Box{vec3(0.25f)}, .position = {3, 0, 0}}};
    Mesh block;  // its face at x = -0.25
    block.vertices = {{-0.25f, -1, -1}, {-0.25f, 1, -1}, {-0.25f, 1, 1}, {-0.25f, -1, 1}};
    block.triangles = {{0, 2, 1}, {0, 3, 2}};
    std::vector<std::vector<Body>> added{{wall({0.35f, 0.25f, 0})},
                                         {at(Box{vec3(0.25f)}, {0.35f, 0.25f, 0}, Motion::kinematic)},
                                         {at(two, {0.35f, 0.25f, 0}, Motion::fixed)},
                                         {at(block, {0.35f, 0.25f, 0}, Motion::fixed)},
                                         {at(Plane{{-1, 0, 0}, -0.1f}, vec3(0), Motion::fixed)},
                                         {at(Box{vec3(0.25f)}, {9, 5, 0}), wall({0.35f, 0.25f, 0}), wall({7, 0, 0})}};
    for (std::size_t i = 0; i < added.size(); ++i) {
        CAPTURE(i);
        Scene scene;
        scene.bodies = {ground(), at(Box{vec3(0.25f)}, {0, 0.25f, 0})};
        World world(scene, {}, 1);
        require_sleep(world, 1);
        world.step(30);  // which are passed over
        if (added[i].size() == 1)
            world.add_body(added[i][0]);
        else
            world.add_bodies(added[i]);
        world.step();
        CHECK(!world.body(1).asleep);
        world.step(240);
        CHECK(world.body(1).position.x == Approx(-0.15f).margin(0.01f));
    }
}
