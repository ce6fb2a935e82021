// Drums, screws, sieves and cones of moving meshes on a device: the bits of the CPU after every stage.
#include <catch2/catch.hpp>

#include "compute/device/lockstep.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/machines.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors while meshes turn among balls", "[vulkan][process:kinds]") {
    const Watched watched;
    const LockstepResult result = compare_in_lockstep(tests::machines(), tests::coarse(), watched.device, 1, 30);
    INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                 << result.detail);
    REQUIRE(result.equal);
}
