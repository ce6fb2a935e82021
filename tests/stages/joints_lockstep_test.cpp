// Joints of every kind in lockstep: equal bits on device and CPU.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/plan/stage_fusion.h"
#include "compute/scene.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "host/vulkan/device.h"
#include "shaders/physics/joint/joint_block.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/jointed.h"

using namespace scree;
using tests::all_kinds;
using tests::entangled;
using tests::spokes;

namespace {

void require_equal(const Scene& scene, int steps) {
    const Watched watched;
    Lockstep lockstep(scene, tests::coarse(), watched.device, 2);
    for (int i = 0; i < steps && lockstep.step(); ++i) continue;
    tests::require_equal(lockstep.result());
}

std::uint32_t rounds_at_once(const Scene& scene) {
    const State state(checked(scene), {}, 64, true);
    return joint_dispatches(state.joints, state.joint_blocks, 8).rounds_at_once;
}

}  // namespace

TEST_CASE("joints that entangle, more than a device's loops have rounds for, give the same bits on both processors",
          "[process:kinds]") {
    // Lavapipe ends a shader's loops after 65,535 iterations in all.
    REQUIRE(rounds_at_once(all_kinds()) == physics::JOINT_ROUNDS);
    REQUIRE(rounds_at_once(spokes()) == physics::JOINT_ROUNDS);
    REQUIRE(rounds_at_once(entangled()) < physics::JOINT_ROUNDS);
    require_equal(spokes(), 5);
    require_equal(entangled(), 3);
    require_equal(entangled(physics::SMALL_BLOCK_JOINTS), 20);
}

TEST_CASE("joints of every kind give the same bits on both processors, and validation stays silent", "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Settings settings = tests::coarse();
    settings.sleep_time = 0.2f;
    Lockstep lockstep(all_kinds(), settings, device, 2);
    for (int i = 0; i < 60 && lockstep.step(); ++i) continue;
    tests::require_equal(lockstep.result());
}

TEST_CASE("joints that turn by several turns give the same bits on both processors", "[process:kinds]") {
    require_equal(tests::turning(), 40);
}

TEST_CASE("joints that come and go while a world runs give the same bits on both processors", "[process:kinds]") {
    const Watched watched;
    Scene bare = all_kinds();
    const std::vector<Joint> joints = bare.joints;
    bare.joints.clear();
    World cpu(bare, tests::coarse(), 2), there(bare, tests::coarse(), make_device_runner(watched.device));
    for (int step = 0; step < 30; ++step) {
        for (World* world : {&cpu, &there}) {
            // No joints, then all; later every second one is removed, and two chains are joined in place.
            if (step == 3)
                for (const Joint& joint : joints) world->add_joint(joint);
            if (step == 12)
                for (std::size_t j = joints.size(); j-- > 0;)
                    if (j % 2 == 1) world->remove_joint(j);
            if (step == 20) world->add_joint(world->joint_at(Fixed{}, 1, 7, world->body(1).position));
            world->step();
        }
        CAPTURE(step);
        REQUIRE(there.state_hash() == cpu.state_hash());
    }
    CHECK(there.joint(2).max_force == cpu.joint(2).max_force);
    CHECK(cpu.statistics().not_finite == 0);
}
