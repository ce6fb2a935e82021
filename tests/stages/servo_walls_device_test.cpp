// Servo walls on a device: the bits of the CPU after every stage.
#include <catch2/catch.hpp>

#include "compute/device/lockstep.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/oedometer.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors while a servo wall presses on grains", "[vulkan][process:kinds]") {
    const Watched watched;
    const Scene scene = tests::Oedometer{.size = "0.16"}.document().scene;
    const LockstepResult result = compare_in_lockstep(scene, tests::coarse(), watched.device, 1, 50);
    INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                 << result.detail);
    REQUIRE(result.equal);
}
