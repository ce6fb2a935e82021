// Copies of a scene on a device: in lockstep with the CPU, reset, and with the bits of the scene alone.
#include <catch2/catch.hpp>
#include <vector>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

void vary(std::size_t copy, Scene& scene) {
    scene.gravity = {static_cast<float>(copy), -9.81f + static_cast<float>(copy), 0};
    for (Body& body : scene.bodies) body.friction = 0.3f + 0.2f * static_cast<float>(copy);
}

}  // namespace

TEST_CASE("copies of a scene with a gravity of their own are equal on both processors after every stage", "[process:kinds]") {
    const Watched watched;
    Lockstep lockstep(tests::heap(10), {.pairs_at_first = 16, .contacts_at_first = 8}, watched.device, 2, 3, vary);
    for (int step = 0; step < 16; ++step) {
        lockstep.step();
        tests::require_equal(lockstep.result());
    }
}

TEST_CASE("copies on a device have the bits of the scene alone, while others are reset and fall asleep", "[process:kinds]") {
    const Watched watched;
    const Scene scene = tests::heap(8);
    const Settings light{.sleep_speed = 0.3f, .sleep_time = 0.1f};
    World alone(scene, light, 2);
    std::vector<std::uint64_t> path{alone.state_hash()};
    for (int step = 0; step < 80; ++step) alone.step(), path.push_back(alone.state_hash());
    REQUIRE(alone.statistics().asleep > 0);
    World world(scene, light, make_device_runner(watched.device), 5);
    world.step(45);
    world.explode({0, 1, 0}, 4, 8, 3);
    world.reset_copy(2);
    world.step(15);
    std::vector<std::uint8_t> mask(5);
    mask[3] = mask[4] = 1;
    world.reset(mask);
    REQUIRE(world.state_hash_of(4) == path[0]);
    world.step(20);
    const std::vector<std::uint64_t> hashes = world.state_hashes();
    for (std::size_t copy = 0; copy < 5; ++copy) {
        INFO("copy " << copy);
        REQUIRE(hashes[copy] == path[copy == 2 ? 35 : (copy > 2 ? 20 : 80)]);
    }
}

TEST_CASE("everything breaks, is joined and driven in copies on a device as in the scene alone, and is reset", "[long]") {
    const Watched watched;
    const Scene scene = tests::museum(2);
    World alone(scene, tests::coarse(), 2);
    World world(scene, tests::coarse(), make_device_runner(watched.device), 2);
    alone.step(24), world.step(24);
    REQUIRE(alone.statistics().broken > 0);
    REQUIRE(world.state_hashes() == std::vector<std::uint64_t>(2, alone.state_hash()));
    world.reset_copy(1);
    world.step(24);
    REQUIRE(world.state_hash_of(1) == alone.state_hash());
    const std::vector<std::byte> mark = world.save();
    World other(scene, tests::coarse(), make_reference_runner(1), 2);
    other.restore(mark);
    world.step(2), other.step(2);
    REQUIRE(world.state_hashes() == other.state_hashes());
}
