// Scaled masses on a device, in lockstep with the CPU: boxes, hulls, and copies with a gravity of their own.
#include <catch2/catch.hpp>

#include "compute/device/lockstep.h"
#include "tests/stages/watched_device.h"
#include "tests/world/laden.h"

using namespace scree;

namespace {

void vary(std::size_t copy, Scene& scene) {
    scene.gravity = {0, -9.81f / static_cast<float>(1 + copy), 0};
}

void check_lockstep(Lockstep& lockstep, int steps) {
    for (int step = 0; step < steps; ++step) {
        lockstep.step();
        const LockstepResult& result = lockstep.result();
        INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                     << result.detail);
        REQUIRE(result.equal);
    }
}

}  // namespace

TEST_CASE("scaled masses are equal on both processors after every stage", "[mass-scaling]") {
    const Watched watched;
    Lockstep slivers(tests::slivers_under_boxes(12, 8, 1).scene, {.pairs_at_first = 16, .contacts_at_first = 8}, watched.device,
                     2);
    check_lockstep(slivers, 150);
    Lockstep columns(tests::laden_column(4, 1, 0.2f, 300), {}, watched.device, 2, 3, vary);
    check_lockstep(columns, 40);
}
