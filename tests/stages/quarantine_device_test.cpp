// Quarantine on a device, stage by stage: the same bodies, in the same step.
#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("a quarantine has the same bits on a device, stage by stage", "[vulkan]") {
    Scene scene = scene_from_json(R"({"bodies": [
        {"shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}, "position": [0.8, 0.51, 0],
         "orientation": [0, 0.25881904, 0, 0.9659258]},
        {"shape": {"box": {"half_extents": [0.6, 0.15, 0.4]}}, "position": [2.4, 0.16000001, 0],
         "orientation": [-0.0, -0.17364818, -0.0, 0.9848077]}],
        "joints": [{"kind": {"slider": {"spring": {"stiffness": 1000000000000.0, "damping": 10, "rest": 1000000.0}}}, "a": 0, "b": 1}]})")
                      .scene;
    for (const Body& body : tests::heap(20).bodies) scene.bodies.push_back(body);
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
    device.set_bodies(std::vector{BodyChange{.body = 1, .position = vec3(30, 5, 0)}});
    processor.set_bodies(std::vector{BodyChange{.body = 1, .position = vec3(30, 5, 0)}});
    device.step(20);
    processor.step(20);
    CHECK(device.state_hash() == processor.state_hash());
    CHECK(device.quarantines().size() == 1);
    // Random program 3309: nobody had read the masses, so the host had none.
    World unread(scene, {}, make_device_runner(watched.device));
    unread.step(40);
    unread.set_bodies(std::vector{BodyChange{.body = 1, .position = vec3(30, 5, 0)}});
    unread.step(20);
    CHECK(unread.state_hash() == processor.state_hash());
}
