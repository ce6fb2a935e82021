// Copies of a scene on a device: in lockstep with the CPU, reset, and with the bits of the scene alone.
#include <catch2/catch.hpp>
#include <vector>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

struct Watched {
    std::shared_ptr<host::Device> device;
    Watched() {
        host::DeviceOptions options;
        options.validation = true;
        device = host::Device::open(options);
    }
    ~Watched() {
        for (const std::string& message : device->validation_messages()) FAIL_CHECK(message);
    }
};

void vary(std::size_t copy, Scene& scene) {
    scene.gravity = {static_cast<float>(copy), -9.81f + static_cast<float>(copy), 0};
    for (Body& body : scene.bodies) body.friction = 0.3f + 0.2f * static_cast<float>(copy);
}

}  // namespace

TEST_CASE("copies of a scene, alike and varied, are equal on both processors after every stage") {
    const Watched watched;
    const std::function<void(std::size_t, Scene&)> variations[] = {{}, vary};
    for (const auto& variation : variations) {
        Lockstep lockstep(tests::museum(12), {.pairs_at_first = 16, .contacts_at_first = 8}, watched.device, 2, 3, variation);
        for (int step = 0; step < 30; ++step) {
            lockstep.step();
            const LockstepResult& result = lockstep.result();
            INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                         << result.detail);
            REQUIRE(result.equal);
        }
    }
}

TEST_CASE("copies on a device have the bits of the scene alone, while others are reset and fall asleep") {
    const Watched watched;
    const Scene scene = tests::heap(12);
    const Settings light{.sleep_speed = 0.3f, .sleep_time = 0.1f};
    World alone(scene, light, 2);
    std::vector<std::uint64_t> path{alone.state_hash()};
    for (int step = 0; step < 120; ++step) alone.step(), path.push_back(alone.state_hash());
    REQUIRE(alone.statistics().asleep > 0);
    World world(scene, light, make_device_runner(watched.device), 9);
    world.step(50);
    world.explode({0, 1, 0}, 4, 8, 3);
    world.reset_copy(7);
    world.step(30);
    std::vector<std::uint8_t> mask(9);
    mask[3] = mask[4] = 1;
    world.reset(mask);
    REQUIRE(world.state_hash_of(4) == path[0]);
    world.step(40);
    const std::vector<std::uint64_t> hashes = world.state_hashes();
    for (std::size_t copy = 0; copy < 9; ++copy) {
        INFO("copy " << copy);
        REQUIRE(hashes[copy] == path[copy == 7 ? 70 : (copy == 3 || copy == 4 ? 40 : 120)]);
    }
}

TEST_CASE("everything breaks, is joined and driven in copies on a device as in the scene alone, and is reset") {
    const Watched watched;
    const Scene scene = tests::museum(12);
    World alone(scene, {}, 2);
    World world(scene, {}, make_device_runner(watched.device), 3);
    alone.step(40), world.step(40);
    REQUIRE(alone.statistics().broken > 0);
    REQUIRE(world.state_hashes() == std::vector<std::uint64_t>(3, alone.state_hash()));
    const std::vector<std::uint8_t> second{0, 1, 0};
    world.reset(second);
    world.step(40);
    REQUIRE(world.state_hash_of(1) == alone.state_hash());
    const std::vector<std::byte> mark = world.save();
    World other(scene, {}, make_reference_runner(1), 3);
    other.restore(mark);
    world.step(10), other.step(10);
    REQUIRE(world.state_hashes() == other.state_hashes());
}
