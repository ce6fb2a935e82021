// Checkpoints of worlds on a device: restored on the CPU and back, with the same bits.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/museum.h"

using namespace scree;

TEST_CASE("a checkpoint of a device goes on on the CPU, and one of the CPU on a device", "[vulkan][process:runs]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    const Scene scene = tests::museum(60);
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), make_device_runner(device));
    const auto go_on = [](World& world, std::uint64_t steps) {
        while (world.steps() < steps) {
            tests::meddle(world);
            world.step();
        }
        return world.state_hash();
    };
    for (const std::uint64_t moment : {0, 11, 24, 70}) {
        INFO("saved after " << moment << " steps");
        REQUIRE(go_on(cpu, moment) == go_on(there, moment));
        const std::vector<std::byte> here = cpu.save(), from_there = there.save();
        REQUIRE(here == from_there);
        const std::uint64_t later = go_on(cpu, moment + 30);
        REQUIRE(go_on(there, moment + 30) == later);
        // Back, in both and crosswise; also to fewer bodies and joints than there are now.
        cpu.restore(from_there);
        there.restore(here);
        REQUIRE(cpu.statistics().penetration_mean == there.statistics().penetration_mean);
        REQUIRE(go_on(cpu, moment + 30) == later);
        REQUIRE(go_on(there, moment + 30) == later);
        World fresh(scene, tests::coarse(), make_device_runner(device));
        fresh.restore(from_there);
        REQUIRE(go_on(fresh, moment + 30) == later);
        cpu.restore(here);
        there.restore(from_there);
    }
}

TEST_CASE("a device passes over steps in which all sleep, and goes on with the bits of the CPU", "[vulkan][process:runs]") {
    Scene scene;
    scene.bodies.resize(6);
    scene.bodies[0].motion = Motion::fixed;
    scene.bodies[0].shape = Plane{};
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) scene.bodies[i].position = vec3(0, static_cast<float>(i) - 0.5f, 0);
    const Watched watched;
    World cpu(scene, tests::coarse(), 1), there(scene, tests::coarse(), make_device_runner(watched.device));
    for (World* world : {&cpu, &there}) {
        world->step(150);
        world->keep_state();
        world->step(1'000'000'000);  // days, were they simulated
        world->step();
    }
    REQUIRE(there.steps() == 1'000'000'151);
    REQUIRE(cpu.save() == there.save());
    for (World* world : {&cpu, &there}) {
        world->apply_impulse(5, vec3(3, 1, 0));
        world->step(10);
    }
    REQUIRE(cpu.save() == there.save());
    for (World* world : {&cpu, &there}) {
        world->roll_back(1'000'000'011);
        world->apply_impulse(5, vec3(3, 1, 0));
        world->step(10);
    }
    REQUIRE(cpu.steps() == 160);
    REQUIRE(cpu.save() == there.save());
}
