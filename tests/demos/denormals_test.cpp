// Every demo and trial, small: equal bits whether the processor keeps denormals or flushes them, which Vulkan leaves to
// the device.
#include <catch2/catch.hpp>

#include "compute/cpu/denormal_lockstep.h"
#include "demos/scenes/demos.h"

using namespace scree;

namespace {

void check_equal(const char* name, const Scene& scene, int steps) {
    const LockstepResult result = compare_flushing(scene, {}, steps);
    INFO(name << ": step " << result.step << ", stage " << result.stage << ", " << result.buffer << "[" << result.element << "], "
              << result.detail);
    CHECK(result.equal);
}

void check_demos(bool trials) {
    for (const demos::Demo& demo : demos::all_demos()) {
        if (demo.trial != trials || (!demo.takes_bodies && demo.bodies > 2000)) continue;
        demos::DemoOptions options;
        options.bodies = demo.takes_bodies ? 120 : 0;
        check_equal(demo.name, demos::build(demo, options).scene, 40);
    }
}

}  // namespace

TEST_CASE("every demo gives the same bits with denormals kept and flushed") {
    if (can_flush_denormals()) check_demos(false);
}

TEST_CASE("every trial gives the same bits with denormals kept and flushed") {
    if (can_flush_denormals()) check_demos(true);
}

// Denormal positions and velocities of grains of 1 mm, in gravity from that of the Earth down to that of a small asteroid.
TEST_CASE("grains at tiny coordinates give the same bits with denormals kept and flushed") {
    if (!can_flush_denormals()) return;
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    for (int i = 0; i < 8; ++i) {
        Body grain;
        grain.shape = i % 2 == 0 ? Shape(Box{{0.001f, 0.001f, 0.001f}}) : Shape(Sphere{0.001f});
        grain.position = {1e-40f, 0.001f + 0.002f * static_cast<float>(i), i == 3 ? 1e-39f : -1e-41f};
        grain.angular_velocity = {1e-30f, 1e-20f, 1e-39f};
        grain.velocity = {0, i == 7 ? -1e-3f : 0, 1e-22f};
        scene.bodies.push_back(grain);
    }
    for (const float gravity : {9.81f, 1.62f, 1e-3f, 1e-6f}) {
        scene.gravity = {0, -gravity, 0};
        INFO("gravity " << gravity);
        check_equal("grains", scene, 120);
    }
}
