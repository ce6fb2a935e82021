// Rollback on a device: states stay in its memory, and have the bits of those on the CPU.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdint>
#include <numeric>
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
    std::array<double, 10> plain{}, again{};  // s, the least of each step: the machine has other work
    double back = 1e9;
    plain.fill(1e9);
    again.fill(1e9);
    const auto ten_steps = [&](bool keep, std::array<double, 10>* least) {
        for (int i = 0; i < 10; ++i) {
            const double seconds = seconds_of([&] {
                if (keep) world.keep_state();
                world.step();
            });
            if (least) (*least)[i] = std::min((*least)[i], seconds);
        }
    };
    const auto total = [](const std::array<double, 10>& steps) { return std::accumulate(steps.begin(), steps.end(), 0.0); };
    world.step(20);
    ten_steps(true, nullptr);  // makes the memory of the kept states
    for (int attempt = 0; attempt < 3 || (attempt < 12 && back + total(again) >= 2 * total(plain)); ++attempt) {
        ten_steps(false, &plain);
        ten_steps(true, nullptr);
        const std::uint64_t hash = world.state_hash();
        back = std::min(back, seconds_of([&] { world.roll_back(10); }));
        ten_steps(true, &again);
        REQUIRE(world.state_hash() == hash);
    }
    WARN("ten steps: " << total(plain) * 1e3 << " ms, back and forward again: " << (back + total(again)) * 1e3 << " ms");
    REQUIRE(back + total(again) < 2 * total(plain));
}
