// Periodic cells on a device: the bits of the CPU after every stage.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/periodic.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors in a periodic cell", "[vulkan][process:kinds]") {
    const Watched watched;
    for (const Scene& scene : {tests::gas_in_cell(2, 0.5f, {0.3f, 0, 0}, {0, -0.2f, 0.1f}), tests::bed_in_cell({3, -9.81f, 0})}) {
        const LockstepResult result = compare_in_lockstep(scene, tests::coarse(), watched.device, 1, 25);
        INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                     << result.detail);
        REQUIRE(result.equal);
    }
}

TEST_CASE("a cell that stretches has the bits of the CPU on a device, and from its checkpoint", "[vulkan][process:kinds]") {
    const Watched watched;
    const Scene scene = tests::gas_in_cell(1, 0.5f, vec3(0), {-0.1f, 0.1f, 0});
    World cpu(scene, tests::coarse(), 1), there(scene, tests::coarse(), make_device_runner(watched.device));
    cpu.step(20);
    there.restore(cpu.save());
    cpu.step(20);
    there.step(20);
    CHECK(there.state_hash() == cpu.state_hash());
    CHECK(there.scene().periodic.size == cpu.scene().periodic.size);
}
