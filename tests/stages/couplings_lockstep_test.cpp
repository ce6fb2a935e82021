// Couplings in lockstep: equal bits on device and CPU.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/plan/stage_fusion.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/coupled.h"
#include "tests/world/jointed.h"

using namespace scree;

namespace {

void require_equal(const Scene& scene, int steps) {
    const Watched watched;
    Settings settings = tests::coarse();
    settings.sleep_time = 0.2f;
    Lockstep lockstep(scene, settings, watched.device, 2);
    for (int i = 0; i < steps && lockstep.step(); ++i) continue;
    tests::require_equal(lockstep.result());
}

// A train of wheels with as many couplings as a block takes.
Scene long_train() {
    Scene scene;
    for (int i = 0; i < 26; ++i) tests::add_wheel(scene, 0.5f * static_cast<float>(i), 0.1f + 0.01f * static_cast<float>(i % 7));
    std::get<Hinge>(scene.joints[0].kind).turn.motor = Motor{20, 5};
    for (std::size_t i = 0; i + 1 < 26; ++i)
        tests::couple(scene, {.joints = {{i, 1}, {i + 1, 1.0f + 0.1f * static_cast<float>(i % 3)}}});
    tests::couple(scene, {.joints = {{0, 1}, {25, 1}, {16, 1}}, .sum = {.spring = Spring{5, 0.1f, 0}}});
    return scene;
}

}  // namespace

TEST_CASE("couplings of every kind give the same bits on both processors, and validation stays silent", "[process:kinds]") {
    require_equal(tests::coupled_kinds(), 70);
}

TEST_CASE("couplings beside blocks of other joints, small and large, give the same bits on both processors", "[process:kinds]") {
    Scene scene = tests::coupled_kinds();
    const std::size_t bodies = scene.bodies.size();
    for (const Scene& more : {tests::all_kinds(), tests::spokes()}) {
        const std::size_t first = scene.bodies.size();
        for (Body body : more.bodies) {
            body.position.z += 8;
            scene.bodies.push_back(body);
        }
        for (Joint joint : more.joints) {
            if (joint.a == the_world) joint.anchor_a.z += 8;
            if (joint.a != the_world) joint.a += first;
            if (joint.b != the_world) joint.b += first;
            scene.joints.push_back(joint);
        }
    }
    REQUIRE(scene.bodies.size() > bodies);
    require_equal(scene, 20);
}

TEST_CASE("more couplings than a device's loops have rounds for give the same bits on both processors", "[process:kinds]") {
    const State state(checked(long_train()), {}, 64, true);
    const JointDispatches found = joint_dispatches(state.joints, state.joint_blocks, 8);
    REQUIRE(found.threads_a_coupled_block == 8);  // too many for one thread
    REQUIRE(found.coupled_rounds_at_once < physics::JOINT_ROUNDS);
    CHECK(found.threads_a_block == 0);
    CHECK(found.threads_a_small_block == 0);
    require_equal(long_train(), 2);
}
