// Quarantine on a device, stage by stage: the same bodies, in the same step.
#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("a quarantine has the same bits on a device, stage by stage", "[vulkan]") {
    Scene scene = tests::heap(20);
    for (const float x : {0.8f, 2.4f}) scene.bodies.push_back({.shape = Box{vec3(0.5f)}, .position = {x, 9, 0}});
    const std::size_t last = scene.bodies.size() - 1;
    scene.joints.push_back({.kind = Slider{Axis{.spring = Spring{1e12f, 10, 1e6f}}}, .a = last - 1, .b = last});
    Watched watched;
    const LockstepResult result = compare_in_lockstep(scene, {}, watched.device, 1, 20, {}, 0);
    INFO("step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
                 << result.detail);
    CHECK(result.equal);
    World device(scene, {}, make_device_runner(watched.device)), processor(scene, {}, 1);
    device.step(40);
    processor.step(40);
    CHECK(device.state_hash() == processor.state_hash());
    CHECK(device.save() == processor.save());
    REQUIRE(device.quarantines().size() == 2);
    CHECK(device.quarantines()[0].step == processor.quarantines()[0].step);
    device.set_bodies(std::vector{BodyChange{.body = last, .position = vec3(30, 5, 0)}});
    processor.set_bodies(std::vector{BodyChange{.body = last, .position = vec3(30, 5, 0)}});
    device.step(20);
    processor.step(20);
    CHECK(device.state_hash() == processor.state_hash());
    CHECK(device.quarantines().size() == 1);
}
