// Rollback on a device: states stay in its memory, and have the bits of those on the CPU.
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <vector>

#include "compute/device/make_device_runner.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

TEST_CASE("a world on a device goes back ten steps and forward again with the bits of the CPU",
          "[stages][vulkan][process:runs]") {
    const bool staged = GENERATE(false, true);
    CAPTURE(staged);
    const Watched watched({.staged = staged});
    const Scene scene = tests::museum(60);
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), make_device_runner(watched.device));
    std::vector<std::uint64_t> hashes;
    const auto go_on = [&](World& world, std::uint64_t steps) {
        while (world.steps() < steps) {
            const std::uint64_t now = world.steps();
            world.keep_state();
            tests::meddle(world);
            world.step();
            if (hashes.size() == now) hashes.push_back(world.state_hash());
            REQUIRE(world.state_hash() == hashes[now]);
        }
    };
    for (const std::uint64_t later : {10, 24, 45}) {
        go_on(cpu, later);
        go_on(there, later);
        for (const std::uint64_t back : {3, 10}) {
            CAPTURE(later, back);
            for (World* world : {&cpu, &there}) {
                world->roll_back(back);
                REQUIRE(world->steps() == later - back);
            }
            REQUIRE(there.save() == cpu.save());
            go_on(cpu, later);
            go_on(there, later);
        }
    }
}

TEST_CASE("going back ten steps and forward again costs less than twice the ten steps, on the CPU and on a device",
          "[stages][vulkan]") {
    const bool on_device = GENERATE(false, true);
    CAPTURE(on_device);
    const Scene scene = tests::packed(1000);
    const auto device = on_device ? host::Device::open() : nullptr;
    World world(scene, {.sleeping = false}, on_device ? make_device_runner(device) : make_reference_runner(0));
    const auto seconds_of = [](const auto& work) {
        const auto begin = std::chrono::steady_clock::now();
        work();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    const auto ten_steps = [&](bool keep) {
        for (int i = 0; i < 10; ++i) {
            if (keep) world.keep_state();
            world.step();
        }
    };
    world.step(20);
    ten_steps(true);  // makes the memory of the kept states
    double plain = 1e9, again = 1e9;
    std::uint64_t hash = 0;
    // The least of each, of more attempts while the machine has other work.
    for (int attempt = 0; attempt < 3 || (attempt < 12 && again >= 2 * plain); ++attempt) {
        plain = std::min(plain, seconds_of([&] { ten_steps(false); }));
        ten_steps(true);
        hash = world.state_hash();
        again = std::min(again, seconds_of([&] {
                             world.roll_back(10);
                             ten_steps(true);
                         }));
        REQUIRE(world.state_hash() == hash);
    }
    WARN("ten steps: " << plain * 1e3 << " ms, back and forward again: " << again * 1e3 << " ms");
    REQUIRE(again < 2 * plain);
}
