// Lockstep: every stage on device and CPU, from equal tables to equal bits, with poisoned outputs.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/parallel/threads.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "shaders/physics/continuous/clamping.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

host::DeviceOptions limited_to(std::uint64_t largest_binding, bool without_texels) {
    host::DeviceOptions options;
    options.largest_binding = largest_binding;
    options.without_texels = without_texels;
    return options;
}

// Compares `steps` steps of a scene with initial contacts. Returns the number of contacts in the first step.
std::uint32_t contacts_walked(const Scene& scene, const Watched& watched, int steps) {
    Lockstep lockstep(scene, {}, watched.device, 1);
    std::vector<physics::Counts> counts(1);
    std::uint32_t contacts = 0;
    for (int step = 0; step < steps; ++step) {
        lockstep.step();
        tests::require_equal(lockstep.result());
        lockstep.device().read(Table::counts, std::as_writable_bytes(std::span(counts)));
        if (step == 0) contacts = counts[0].contacts;
        REQUIRE(counts[0].steps == static_cast<std::uint32_t>(step + 1));
    }
    return contacts;
}

}  // namespace

TEST_CASE("tables longer than a binding are found by address, from the start or once they have grown, with the same bits",
          "[process:stages]") {
    Settings small;
    small.pairs_at_first = small.contacts_at_first = 8;
    const bool without_texels = GENERATE(false, true);
    for (const std::uint64_t largest_binding : {1024u, 65536u}) {
        CAPTURE(largest_binding, without_texels);
        const Watched watched(limited_to(largest_binding, without_texels));
        Lockstep lockstep(tests::packed(300), small, watched.device, 1);
        REQUIRE(lockstep.device().reach() == (largest_binding == 1024 ? host::Reach::far : host::Reach::bound));
        for (int step = 0; step < 10; ++step) {
            lockstep.step();
            tests::require_equal(lockstep.result());
        }
        REQUIRE(lockstep.device().reach() == host::Reach::far);
    }
}

TEST_CASE("every stage gives the same bits on both processors where tables are not read as texels", "[process:stages]") {
    const Watched watched(limited_to(0, /* without_texels */ true));
    REQUIRE(contacts_walked(tests::packed(300), watched, 10) > 300);
}

TEST_CASE("every stage gives the same bits on both processors, whatever the number of bodies", "[process:stages]") {
    const Watched watched;
    for (const unsigned bodies : {0u, 1u, 2u, 126u, 127u, 128u, 129u, 1234u}) {
        CAPTURE(bodies);
        const std::uint32_t contacts = contacts_walked(tests::packed(static_cast<int>(bodies)), watched, bodies > 1000 ? 4 : 10);
        REQUIRE(contacts >= bodies);
        if (bodies > 2) REQUIRE(contacts > bodies);
    }
}

TEST_CASE("every stage gives the same bits on both processors, even of a scene without a body", "[process:stages]") {
    const Watched watched;
    REQUIRE(contacts_walked({}, watched, 3) == 0);
}

TEST_CASE("every stage gives the same bits on both processors, whatever the number of contacts", "[process:stages]") {
    const Watched watched;
    for (const unsigned bodies : {1u, 2u, 3u, 63u, 64u, 65u, 127u, 128u, 129u, 255u, 256u, 257u}) {
        CAPTURE(bodies);
        REQUIRE(contacts_walked(tests::apart(static_cast<int>(bodies)), watched, 4) == bodies);
    }
}

TEST_CASE("both processors stay alike while a heap collapses, with 1, 3 and 16 substeps", "[process:stages]") {
    const Watched watched;
    for (const int substeps : {1, 3, 16}) {
        CAPTURE(substeps);
        Settings settings;
        settings.substeps = substeps;
        tests::require_equal(compare_in_lockstep(tests::heap(100), settings, watched.device, 2, 60));
    }
}

TEST_CASE("both processors stay alike where no body sleeps: what no stage writes is not compared", "[process:stages]") {
    const Watched watched;
    Settings awake;
    awake.sleeping = false;
    tests::require_equal(compare_in_lockstep(tests::packed(60), awake, watched.device, 1, 3));
}

TEST_CASE("every stage gives the same bits on both processors whatever contacts of the scene there cannot be",
          "[process:stages]") {
    const Watched watched;
    Scene boxes;
    boxes.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < 8; ++i)
        boxes.bodies.push_back({.shape = Box{vec3(0.3f, 0.2f, 0.25f)},
                                .position = {0.4f * static_cast<float>(i % 2), 0.19f + 0.41f * static_cast<float>(i), 0},
                                .velocity = {1, -3, 0.5f}});
    const auto with = [&](auto change) {
        Scene scene = boxes;
        change(scene.bodies);
        return scene;
    };
    const Scene scenes[] = {
        boxes,
        with([](auto& bodies) { bodies[1].restitution = 0.7f; }),
        with([](auto& bodies) { bodies[0].rolling_resistance = 0.02f; }),
        with([](auto& bodies) { bodies[3].shape = Sphere{0.3f}; }),
        with([](auto& bodies) {
            bodies[2].shape = Capsule{0.2f, 0.2f};
        }),
        with([](auto& bodies) {
            bodies[1].shape = Cylinder{0.3f, 0.1f};
            bodies[1].tyre = Tyre{};
            bodies[1].orientation = {0.70710678f, 0, 0, 0.70710678f};
            bodies[1].position.y = 0.29f;
        }),
    };
    for (const Scene& scene : scenes) {
        CAPTURE(&scene - scenes);
        REQUIRE(contacts_walked(scene, watched, 20) > 0);
    }
}

namespace {

Scene plate_under_balls(int edge) {
    const float half = 0.6f * static_cast<float>(edge);
    Scene scene;
    scene.bodies.resize(2);
    scene.bodies[0].shape = Plane{};
    scene.bodies[0].motion = Motion::fixed;
    scene.bodies[1].shape = Box{{half, 0.5f, half}};
    scene.bodies[1].position = {0, 0.5f, 0};
    for (int i = 0; i < edge * edge; ++i) {
        Body& ball = scene.bodies.emplace_back();
        ball.shape = Sphere{0.5f};
        ball.position = {1.1f * static_cast<float>(i % edge - edge / 2), 1.495f, 1.1f * static_cast<float>(i / edge - edge / 2)};
    }
    return scene;
}

}  // namespace

// Lengths about those of the parts in which workgroups sort lists (shaders/stages/lib/sort.glsl): 1, 32, 1,024 items.
TEST_CASE("the contacts of a plate under few balls and thousands are put in one order on both processors", "[process:stages]") {
    const Watched watched;
    for (const int edge : {1, 5, 6, 8, 31, 32, 33, 46, 70}) {
        CAPTURE(edge);
        const Scene scene = checked(plate_under_balls(edge));
        Lockstep lockstep(scene, {}, watched.device, 1);
        for (const bool reorders : {false, true}) {
            std::vector<std::uint32_t> rows(scene.bodies.size());
            std::iota(rows.begin(), rows.end(), 0u);
            std::shuffle(rows.begin(), rows.end(), std::mt19937(5));
            if (reorders) lockstep.change([&](State& state) { state.reorder(rows, Threads(2)); });
            lockstep.step();
            tests::require_equal(lockstep.result());
        }
    }
}

// Lavapipe ends a shader's loops after 65,535 rounds in all.
TEST_CASE("a plate that bears thirty thousand balls has the same bits on both processors", "[process:stages]") {
    const Watched watched;
    const Scene scene = plate_under_balls(174);
    World here(scene, {}, 2), there(scene, {}, std::make_unique<DeviceRunner>(watched.device));
    here.step(2);
    there.step(2);
    CHECK(there.statistics().manifolds > 174 * 174);
    CHECK(there.state_hash() == here.state_hash());
}

TEST_CASE("a plate that bears more balls than a software device can do is refused by name, not simulated wrongly",
          "[process:stages]") {
    const Watched watched;
    if (!watched.device->report().is_processor) return;
    World too_many(plate_under_balls(245), {}, std::make_unique<DeviceRunner>(watched.device));
    CHECK_THROWS_WITH(too_many.step(),
                      Catch::Contains("a body has 60026 contacts and joints") && Catch::Contains("--backend cpu"));
}

TEST_CASE("a cell with thousands of bodies has the same bits on both processors", "[process:stages]") {
    const Watched watched;
    Scene scene;
    scene.bodies.resize(5001);
    for (Body& ball : scene.bodies) {
        ball.shape = Sphere{0.5f};
        ball.position = {0.1f, 0.1f, 0.1f};
        ball.filter = Filter{.group = -1};  // they collide with none
    }
    scene.bodies.back().filter = {};
    World here(scene, {}, 2), there(scene, {}, std::make_unique<DeviceRunner>(watched.device));
    here.step();
    there.step();
    CHECK(there.statistics().manifolds == 5000);
    CHECK(there.state_hash() == here.state_hash());
}

// A ring of balls, each of which meets the crowded cell in another row of cells.
TEST_CASE("a cell that threads meet in different rows has the same bits on both processors, or is refused by name",
          "[process:stages]") {
    const Watched watched;
    for (const std::size_t crowd : {6500u, 12000u}) {
        Scene scene;
        scene.gravity = vec3(0);
        scene.bodies.resize(64 + crowd);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            Body& ball = scene.bodies[i];
            ball.shape = Sphere{0.5f};
            ball.position = {0.5f, 0.5f, 0.5f};
            if (i >= 64) ball.motion = Motion::fixed;
            const float turn = 0.7f * static_cast<float>(i);
            if (i < 64) ball.position += 1.25f * vec3(0, std::cos(turn), std::sin(turn));
            if (i < 64) ball.velocity = {0, -0.1f, 0.1f};
        }
        World here(scene, {}, 2), there(scene, {}, std::make_unique<DeviceRunner>(watched.device));
        if (crowd > 6600 && watched.device->report().is_processor) {
            CHECK_THROWS_WITH(there.step(), Catch::Contains("a row of cells of the broadphase has 12000 bodies"));
            continue;
        }
        here.step();
        there.step();
        CHECK(there.state_hash() == here.state_hash());
    }
}

TEST_CASE("both processors stop fast bodies alike", "[process:stages]") {
    const Watched watched;
    for (const float faster : {10.0f, 60.0f}) {
        Scene scene = tests::swarm(150, 0.5f);
        for (Body& body : scene.bodies) body.velocity *= faster;
        Body wall;
        wall.motion = Motion::fixed;
        wall.shape = Box{vec3(0.02f, 20, 20)};
        wall.position.x = 6;
        scene.bodies.push_back(wall);
        Lockstep lockstep(scene, {}, watched.device, 1);
        std::vector<physics::Bounds> bounds(scene.bodies.size());
        int stopped = 0;
        for (int step = 0; step < 30; ++step) {
            lockstep.step();
            tests::require_equal(lockstep.result());
            lockstep.device().read(Table::bounds, std::as_writable_bytes(std::span(bounds)));
            for (const physics::Bounds& around : bounds) stopped += physics::stop_of(around.sweep) < 1;
        }
        REQUIRE(stopped > 50);
    }
}

TEST_CASE("both processors grow their buffers alike", "[process:stages]") {
    const Watched watched;
    Settings tiny;
    tiny.pairs_at_first = 1;
    tiny.contacts_at_first = 1;
    const Scene scene = tests::heap(150);
    tests::require_equal(compare_in_lockstep(scene, tiny, watched.device, 1, 60));

    World roomy(scene, {}, 1);
    World cramped(scene, tiny, make_device_runner(watched.device));
    for (World* world : {&roomy, &cramped}) {
        world->apply_impulse(3, vec3(100, 0, 0));
        world->step(60);
    }
    REQUIRE(cramped.buffer_growths() > 0);
    REQUIRE(cramped.state_hash() == roomy.state_hash());
    REQUIRE(cramped.statistics().points == roomy.statistics().points);
}

TEST_CASE("a single bit that differs is found, with its stage, buffer and element", "[process:stages]") {
    const Watched watched;
    Lockstep lockstep(tests::heap(20), {}, watched.device, 1);
    REQUIRE(lockstep.step());
    std::vector<physics::Velocity> velocities(21);
    const auto bytes = std::as_writable_bytes(std::span(velocities));
    lockstep.device().read(Table::velocities, bytes);
    velocities[13].angular.z = std::nextafter(velocities[13].angular.z, 1.0f);
    lockstep.device().write(Table::velocities, bytes);
    REQUIRE_FALSE(lockstep.step());
    REQUIRE(lockstep.result().stage == "apply_actions");
    REQUIRE(lockstep.result().buffer == "velocities");
    REQUIRE(lockstep.result().element == 13);
    REQUIRE_THAT(lockstep.result().detail, Catch::StartsWith("byte 24: cpu 0x"));
}

TEST_CASE("what acts from outside acts alike on both processors", "[process:stages]") {
    const Watched watched;
    World cpu(tests::heap(40), {}, 1);
    World device(tests::heap(40), {}, make_device_runner(watched.device));
    for (int step = 0; step < 40; ++step) {
        for (World* world : {&cpu, &device}) {
            world->apply_force(4, vec3(0, 3000, 20), vec3(0.1f, 0, 0));
            world->apply_torque(5, vec3(50, 0, 3));
            if (step == 10) world->apply_impulse(7, vec3(200, 300, 0), vec3(0, 0.2f, 0));
            if (step == 20) world->apply_angular_impulse(8, vec3(0, 40, 0));
            if (step == 30) world->set_velocity(9, vec3(0, 5, 0), vec3(1, 2, 3));
            world->step();
        }
        REQUIRE(cpu.state_hash() == device.state_hash());
    }
}

TEST_CASE("two fragments that touch through a step take many rounds of advancement, with the same bits on both processors",
          "[process:stages]") {
    Scene scene;
    Body splinter{.shape = Ellipsoid{{0.10693883f, 1.9163887f, 0.0034199531f}},
                  .position = {-0.33818206f, 1.1643378f, 0.4126723f}};
    splinter.fracture = Fracture{.impulse = 2.1164585f, .pieces = 15};
    splinter.rolling_resistance = 1e5f;
    Body egg{.shape = Ellipsoid{{0.93228327f, 0.28185306f, 0.41069023f}}, .position = {0.04772896f, 1.7314215f, 0.23719242f}};
    egg.rolling_resistance = 1e5f;
    scene.bodies = {splinter, egg};
    contacts_walked(scene, Watched(), 12);
}

TEST_CASE("a gravity scale below zero gives the same bits on both processors, also along axes without gravity",
          "[process:stages]") {
    Scene scene = tests::packed(20);
    for (Body& body : scene.bodies) body.gravity_scale = -0.001f;
    contacts_walked(scene, Watched(), 3);
}
