// User actions in lockstep: equal bits on device and CPU.
#include <catch2/catch.hpp>

#include "compute/compile/state_editor.h"
#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

physics::Grip hold(physics::uint body, vec3 anchor, vec3 target) {
    physics::Grip grip{};
    grip.body = body;
    grip.anchor = anchor;
    grip.target = target;
    grip.bias_rate = 15;
    grip.mass_scale = 0.13f;
    grip.most = 0.6f;
    grip.spin_kept = 0.99f;
    return grip;
}

Body thrown(Shape shape, vec3 from, vec3 velocity) {
    Body body;
    body.shape = shape;
    body.position = from;
    body.velocity = velocity;
    body.angular_velocity = vec3(1, 2, 3);
    return body;
}

// All user actions, at fixed steps of a run of 90.
void act(World& world, std::size_t& grip) {
    switch (world.steps()) {
        case 5:
            grip = world.grip(7, vec3(0.2f, 0.1f, -0.1f), vec3(0, 4, 0));
            break;
        case 10:
            world.set_gravity(vec3(1, -9, 0.5f));
            break;
        case 15:
            world.move_grip(grip, vec3(3, 2, 1));
            world.add_body(thrown(Sphere{0.4f}, vec3(-6, 3, 0), vec3(20, 0, 0)));
            break;
        case 25:
            world.set_friction_factor(0.2f);
            world.set_least_restitution(0.5f);
            break;
        case 30:
            world.set_substeps(3);
            break;
        case 40:
            world.add_body(thrown(Capsule{0.2f, 0.4f}, vec3(0, 6, 0), vec3(0, -9, 0)));
            world.explode(vec3(0, 0, 0), 5, 8);
            break;
        case 50:
            world.release(grip);
            world.set_substeps(11);
            break;
        default:
            world.apply_force(3, vec3(500, 0, 0));
    }
}

}  // namespace

TEST_CASE("every stage gives the same bits on both processors while bodies are held", "[process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Lockstep lockstep(tests::heap(60), tests::coarse(), device, 1);
    for (int step = 0; step < 60; ++step) {
        lockstep.change([&](State& state) {
            physics::Parameters& p = state.fixed();
            p.held = static_cast<physics::uint>(step % 5);
            p.grips[0] = hold(5, vec3(0.1f, 0.2f, 0), vec3(0, 3, 0.1f * static_cast<float>(step)));
            p.grips[1] = hold(9, vec3(0), vec3(2, 1, 0));
            p.grips[2] = hold(5, vec3(-0.1f, 0, 0.1f), vec3(0, -3, 0));  // a second grab of the same body
            p.grips[3] = hold(31, vec3(0.05f, 0, 0), vec3(1e5f, 0, 0));
        });
        lockstep.step();
        tests::require_equal(lockstep.result());
    }
}

TEST_CASE("every stage gives the same bits on both processors after the dials were turned and bodies were added",
          "[process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Settings settings = tests::coarse();
    Lockstep lockstep(tests::heap(60), settings, device, 1);
    for (int step = 0; step < 60; ++step) {
        if (step % 10 == 9) {
            settings.substeps = 1 + (settings.substeps + 4) % 9;
            settings.friction_factor *= 0.7f;
            settings.least_restitution = 0.1f * static_cast<float>(step / 10);
            lockstep.edit(
                [&](const StateEditor& editor) { return editor.needed_to_tune(settings); },
                [&](StateEditor& editor) { return editor.tune(vec3(0.1f * static_cast<float>(step), -9, 0), settings); });
        }
        if (step % 7 == 3) {
            const Body box = thrown(Box{vec3(0.3f, 0.2f, 0.25f)}, vec3(0, 3 + step, 0), vec3(0, -10, 0));
            lockstep.edit([](const StateEditor& editor) { return editor.needed_to_add(); },
                          [&](StateEditor& editor) { return editor.add(box); });
        }
        lockstep.step();
        tests::require_equal(lockstep.result());
    }
}

TEST_CASE("a world that a user plays with has the same bits on both processors, whatever room its buffers begin with",
          "[process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Settings tiny = tests::coarse();
    tiny.pairs_at_first = 1;
    tiny.contacts_at_first = 1;
    World cpu(tests::heap(60), tests::coarse(), 2), there(tests::heap(60), tests::coarse(), make_device_runner(device));
    World cramped(tests::heap(60), tiny, make_device_runner(device));
    std::size_t grip = 0;
    for (int step = 0; step < 90; ++step) {
        for (World* world : {&cpu, &there, &cramped}) {
            act(*world, grip);
            world->step();
        }
        CAPTURE(step);
        REQUIRE(there.state_hash() == cpu.state_hash());
        REQUIRE(cramped.state_hash() == cpu.state_hash());
    }
    REQUIRE(cpu.scene().bodies.size() == 63);
    const std::vector<BodyState> bodies = there.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) REQUIRE(there.body(i).position == bodies[i].position);
    REQUIRE(cpu.statistics().not_finite == 0);
}
