// Queues and limits of devices: queues that compute only, steps submitted in pieces, inputs that travel with a step, allocations
// that are too large.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "host/canvas/canvas.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

std::unique_ptr<DeviceRunner> runner_on(const Watched& watched) {
    return std::make_unique<DeviceRunner>(watched.device);
}

}  // namespace

TEST_CASE("a device whose queue only computes simulates with the bits of the CPU, and canvases say what draws instead",
          "[stages][vulkan][process:runs]") {
    const Watched watched({.without_graphics = true});
    const Scene scene = tests::museum(60);
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), runner_on(watched));
    cpu.step(20);
    there.step(20);
    CHECK(there.state_hash() == cpu.state_hash());
    CHECK_THROWS_WITH(host::make_vulkan_canvas(watched.device, {}, {}),
                      Catch::Contains("no queue with graphics; draw with OpenGL ES"));
}

TEST_CASE("a step that takes long is submitted in pieces, with the same bits, overflowing lists and times of its stages",
          "[stages][vulkan][process:runs]") {
    const bool timed = GENERATE(false, true);
    CAPTURE(timed);
    const Watched watched;
    const Scene scene = tests::museum(60);
    World cpu(scene, tests::coarse(), 2);
    auto runner = runner_on(watched);
    DeviceRunner& device = *runner;
    device.submit_within(1e-4);
    World there(scene, tests::coarse(), std::move(runner));
    there.set_profiling(timed);
    CHECK(device.submissions_of_a_step() == 1);
    for (const int steps : {1, 1, 30}) {
        cpu.step(steps);
        there.step(steps);
        REQUIRE(there.state_hash() == cpu.state_hash());
    }
    CHECK(device.submissions_of_a_step() > 4);
    if (!timed) return;
    for (const auto& [stage, milliseconds] : there.stage_times()) {
        CAPTURE(stage);
        CHECK(milliseconds >= 0);
    }
}

// A device may have room for 65,535 workgroups along an axis, which is few for a million bodies.
TEST_CASE("dispatches of more workgroups than one axis has room for give the same bits in every stage",
          "[stages][vulkan][process:runs]") {
    const std::uint32_t most_groups = GENERATE(1, 3);
    CAPTURE(most_groups);
    const Watched watched({.most_groups = most_groups});
    const auto check = [&](const Scene& scene, int steps, std::size_t least_in_rows) {
        Settings small = tests::coarse();
        small.pairs_at_first = small.contacts_at_first = 8;  // lists grow
        Lockstep lockstep(scene, small, watched.device, 1);
        for (int step = 0; step < steps; ++step) {
            lockstep.step();
            tests::require_equal(lockstep.result());
        }
        std::vector<physics::Counts> counts(1);
        lockstep.device().read(Table::counts, std::as_writable_bytes(std::span(counts)));
        std::size_t in_rows = 0;
        for (const physics::uvec4& work : counts[0].arguments) {
            CHECK(work.x <= most_groups);
            in_rows += work.y > 1;
        }
        CHECK(in_rows >= least_in_rows);
        if (least_in_rows > 0) CHECK_FALSE(lockstep.device().is_fused());
    };
    check(tests::packed(1500), 12, 6);
    for (const char* name : {"ragdolls", "cars", "shatter", "terrain"}) {
        const demos::Demo* demo = demos::find_demo(name);
        REQUIRE(demo != nullptr);
        CAPTURE(name);
        check(demos::build(*demo, {.bodies = demo->takes_bodies ? 800u : 0u, .seed = 1, .offset = 0}).scene, 4, 0);
    }
}

TEST_CASE("actions and edits of parameters between steps reach the device with the step, in every way of running steps",
          "[stages][vulkan][process:runs]") {
    const bool staged = GENERATE(false, true);
    CAPTURE(staged);
    const Watched watched({.staged = staged});
    const Scene scene = tests::packed(40);
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), runner_on(watched));
    const std::size_t last = scene.bodies.size() - 1;
    for (World* world : {&cpu, &there}) {
        for (int k = 0; k < 12; ++k) {
            world->apply_impulse(last - static_cast<std::size_t>(k) % 5, {0.0f, 40.0f + static_cast<float>(k), 5.0f});
            if (k % 4 == 1) world->set_gravity({0.1f * static_cast<float>(k), -9.0f, 0.0f});
            world->step(1 + k % 3);
        }
    }
    CHECK(there.state_hash() == cpu.state_hash());
}

TEST_CASE("a table that a device cannot allocate at once is refused with the limit and with what would fit",
          "[stages][vulkan][process:runs]") {
    const Watched watched({.largest_buffer = 40'000});
    const Scene scene = tests::packed(2000);
    CHECK_THROWS_WITH(World(scene, tests::coarse(), runner_on(watched)),
                      Catch::Contains("maxMemoryAllocationSize") && Catch::Contains("bodies like these would fit"));
}
