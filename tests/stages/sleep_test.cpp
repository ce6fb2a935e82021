// Sleep and waking in lockstep: equal bits while bodies fall asleep, are hit, and lose their support.
#include <catch2/catch.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "compute/compile/scene_compiler.h"
#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "shaders/physics/sleep/sleep.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// Small bodies at rest, which a large ball and a kinematic box hit after some steps.
Scene struck(Scene scene) {
    Body ball;
    ball.shape = Sphere{0.8f};
    ball.position = vec3(1, 4, 1);
    ball.velocity = vec3(2, -5, 1);
    scene.bodies.push_back(ball);
    Body sweep;
    sweep.motion = Motion::kinematic;
    sweep.shape = Box{vec3(0.3f, 0.3f, 2)};
    sweep.position = vec3(-4, 0.4f, 0);
    sweep.velocity = vec3(9, 0, 0);
    scene.bodies.push_back(sweep);
    return scene;
}

// Columns of three boxes, 1 cm apart, so that an impact propagates through all of them.
Scene columns(unsigned boxes) {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    const auto side = static_cast<unsigned>(std::ceil(std::sqrt(boxes / 3.0)));
    for (unsigned i = 0; i < boxes; ++i) {
        const vec3 cell(i / 3 % side, i % 3, i / 3 / side);
        scene.bodies.push_back({.shape = Box{vec3(0.2f)}, .position = cell * vec3(0.41f, 0.4f, 0.41f) + vec3(0, 0.2f, 0)});
    }
    return scene;
}

struct Seen {
    std::size_t asleep = 0;             // maximum at any time
    std::size_t woken = 0, shaken = 0;  // totals
};

Seen walk(const Scene& scene, const Settings& settings, const Watched& watched, int steps) {
    Lockstep lockstep(scene, settings, watched.device, 2);
    const physics::uint sleep_steps = sleep_steps_of(settings);
    std::vector<physics::uint> sleep_states(scene.bodies.size()), before = sleep_states;
    Seen seen;
    for (int step = 0; step < steps; ++step) {
        lockstep.step();
        tests::require_equal(lockstep.result());
        lockstep.device().read(Table::sleep_states, std::as_writable_bytes(std::span(sleep_states)));
        std::size_t asleep = 0;
        for (std::size_t i = 0; i < sleep_states.size(); ++i) {
            const bool sleeps = physics::is_asleep(sleep_states[i], sleep_steps);
            asleep += sleeps;
            seen.woken += physics::is_asleep(before[i], sleep_steps) && !sleeps;
        }
        seen.asleep = std::max(seen.asleep, asleep);
        before = sleep_states;
    }
    return seen;
}

}  // namespace

TEST_CASE("bodies fall asleep and are struck with the same bits on both processors, whatever their number", "[process:changes]") {
    const Watched watched;
    Settings light = tests::coarse();  // sleepers
    light.sleep_time = 0.08f;
    light.sleep_speed = 0.2f;
    for (const unsigned bodies : {0u, 1u, 125u, 126u, 127u, 128u, 129u, 1234u}) {
        CAPTURE(bodies);
        const Seen seen = walk(struck(tests::apart(static_cast<int>(bodies))), light, watched, bodies > 1000 ? 24 : 50);
        REQUIRE(seen.asleep >= bodies * 3 / 4);
        if (bodies > 100) REQUIRE(seen.woken > 0);
    }
}

TEST_CASE("columns fall asleep, are struck and shaken with the same bits on both processors", "[process:changes]") {
    const Watched watched;
    Settings light = tests::coarse();
    light.sleep_time = 0.08f;
    for (const unsigned boxes : {27u, 127u, 128u, 300u}) {
        CAPTURE(boxes);
        const Seen seen = walk(struck(columns(boxes)), light, watched, 50);
        REQUIRE(seen.asleep > boxes * 3 / 4);
        REQUIRE(seen.woken > boxes / 8);
    }
}

TEST_CASE("both processors grow their buffers alike while bodies sleep and wake", "[process:changes]") {
    const Watched watched;
    Settings tiny = tests::coarse();
    tiny.pairs_at_first = 1;
    tiny.contacts_at_first = 1;
    tiny.sleep_time = 0.08f;
    const Seen seen = walk(struck(columns(60)), tiny, watched, 50);
    REQUIRE(seen.asleep > 40);
    REQUIRE(seen.woken > 10);
}

TEST_CASE("what the user asks of sleepers is done alike on both processors", "[process:changes]") {
    const Watched watched;
    Settings light = tests::coarse();
    light.sleep_time = 0.1f;
    const Scene scene = tests::apart(40);
    World cpu(scene, light, 2);
    World device(scene, light, make_device_runner(watched.device));
    std::size_t most = 0;
    for (int step = 0; step < 120; ++step) {
        for (World* world : {&cpu, &device}) {
            if (step == 30) world->set_velocity(3, vec3(4, 1, 2), vec3(0));
            if (step == 40) world->wake(5);
            if (step == 50) world->wake_all();
            if (step == 80) world->set_sleeping(false);
            if (step == 90) world->set_sleeping(true);
            world->step();
        }
        REQUIRE(cpu.state_hash() == device.state_hash());
        const Statistics here = cpu.statistics(), there = device.statistics();
        REQUIRE(here.asleep == there.asleep);
        REQUIRE(here.points == there.points);
        if (step == 50 || step == 80) REQUIRE(here.asleep == 0);
        if (step == 49 || step == 79 || step == 119) REQUIRE(here.asleep > 20);
        most = std::max(most, here.asleep);
    }
    REQUIRE(most > 20);
}
