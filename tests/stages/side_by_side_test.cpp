// Worlds of their own run side by side on threads of their own, also on one device, with the bits of one alone.
#include <catch2/catch.hpp>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "compute/device/make_device_runner.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("worlds on one device, each stepped by a thread of its own, have the bits of one alone", "[stages][vulkan]") {
    const Watched watched;
    const Scene scene = tests::heap(60);
    World alone(scene, {}, 1);
    alone.step(40);
    std::vector<std::uint64_t> hashes(4);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < hashes.size(); ++i)
        threads.emplace_back([&, i] {
            World world(scene, {}, i < 3 ? make_device_runner(watched.device) : make_reference_runner(2));
            world.step(20);
            world.keep_state();
            world.step(10);
            world.roll_back(10);
            world.step(20);
            hashes[i] = world.state_hash();
        });
    for (std::thread& thread : threads) thread.join();
    REQUIRE(hashes == std::vector<std::uint64_t>(4, alone.state_hash()));
}
