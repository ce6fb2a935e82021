// Edits and losses on the devices of ranks: what is told is as on one CPU.
#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "compute/device/make_device_runner.h"
#include "tests/stages/watched_device.h"
#include "tests/world/on_ranks.h"
#include "tests/world/ownerless.h"
#include "tests/world/sleepers.h"

using namespace scree;

namespace {

void agree_on_devices(const Scene& scene, const tests::TellingScript& script) {
    std::vector<std::unique_ptr<Watched>> devices;  // one after the other: drivers are loaded once
    for (int r = 0; r < 2; ++r) devices.push_back(std::make_unique<Watched>(r));
    const std::vector<tests::Lines> told = tests::told_by_ranks(2, scene, script, [&](const std::shared_ptr<Exchange>& exchange) {
        return make_distributed_runner(exchange, devices[static_cast<std::size_t>(exchange->rank())]->device);
    });
    tests::check_alike(told, tests::told_by_one(scene, script));
}

void agree_on_devices(const tests::Ownerless& one) {
    agree_on_devices(one.scene, one.script);
}

}  // namespace

TEST_CASE("joints of bodies that have broken are told by ranks on devices as on one CPU", "[vulkan][ranks][process:shares]") {
    agree_on_devices(tests::joints_of_broken_bodies());
}

TEST_CASE("a vehicle whose chassis has broken is told by ranks on devices as on one CPU", "[vulkan][ranks][process:shares]") {
    agree_on_devices(tests::broken_vehicle());
}

TEST_CASE("springs of joints of several ranks are set on their devices as on one CPU", "[vulkan][ranks][process:shares]") {
    agree_on_devices(tests::pairs_on_springs(6), [](World& world) {
        world.step(5);
        for (const std::size_t joint : {4, 1}) world.set_spring(joint, JointAxis::x, {.stiffness = 20000, .rest = 0.5f});
        world.step(5);
        return tests::Lines{hash_text(world.state_hash()), tests::line_of_joints(world)};
    });
}

// The first rope was taut and is slack: its record stays as it is when the new joint comes, and is then an old one on the device
// of the other rank, whose bodies come over.
TEST_CASE("a joint that unites blocks of two ranks leaves the joints of both as they are on devices",
          "[vulkan][ranks][process:shares]") {
    Scene scene;
    scene.gravity = vec3(0);
    for (std::size_t k = 0; k < 6; ++k) {
        scene.bodies.push_back(at(Sphere{0.2f}, vec3(2 * static_cast<int>(k) + (k < 3 ? 0 : 40), 0.5f, 0)));
        if (k % 3 > 0) scene.joints.push_back({.kind = Distance{.greatest = 2.1f}, .a = k - 1, .b = k});
    }
    scene.bodies[0].velocity = vec3(-3, 0, 0);
    agree_on_devices(scene, [](World& world) {
        world.step(5);
        world.set_velocity(0, vec3(1, 0, 0), vec3(0));
        world.step(5);
        world.add_joint({.kind = Distance{.greatest = 60}, .a = 2, .b = 3});
        world.step(2);
        return tests::Lines{hash_text(world.state_hash()), tests::line_of_joints(world)};
    });
}
