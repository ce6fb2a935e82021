// Bonds on a device: the bits of the CPU after every stage.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/bonded.h"
#include "tests/world/coarse.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors while bonds hold and break", "[vulkan][process:kinds]") {
    const Watched watched;
    const LockstepResult result = compare_in_lockstep(tests::falling_blocks(), tests::coarse(), watched.device, 1, 40);
    INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                 << result.detail);
    REQUIRE(result.equal);
}

TEST_CASE("a device goes on from a checkpoint of the CPU, and after reordering, with its bits while bonds break",
          "[vulkan][process:kinds]") {
    const Watched watched;
    const Scene scene = tests::falling_blocks();
    World cpu(scene, tests::coarse(), 1), there(scene, tests::coarse(), make_device_runner(watched.device));
    cpu.step(25);
    there.restore(cpu.save());
    there.reorder();
    cpu.step(25);
    there.step(25);
    CHECK(there.state_hash() == cpu.state_hash());
    CHECK(there.statistics().bonds_broken == cpu.statistics().bonds_broken);
    CHECK(cpu.statistics().bonds_broken > 0);
}
