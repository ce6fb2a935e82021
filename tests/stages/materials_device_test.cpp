// Materials, sensors, targets and joints that come and go on a device: the bits of the CPU.
#include <catch2/catch.hpp>
#include <vector>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/belts.h"
#include "tests/world/coarse.h"
#include "tests/world/late_restitution.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors for materials, sensors and explicit masses",
          "[vulkan][process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    tests::require_equal(compare_in_lockstep(tests::belts(60), tests::coarse(), device, 1, 90));
}

TEST_CASE("every stage gives the same bits on both processors in wind and water", "[vulkan][process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Scene scene = tests::belts(40);
    scene.fields = {.wind = Wind{.velocity = {4, 0, 1}},
                    .water = Water{.offset = 0.4f, .velocity = {0.3f, 0, 0}},
                    .attractors = {{.position = {0, 3, 0}, .strength = 20}}};
    tests::require_equal(compare_in_lockstep(scene, tests::coarse(), device, 1, 60));
}

TEST_CASE("a device gives the bits and the events of the CPU while materials change and kinematic bodies move to targets",
          "[vulkan][process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Scene scene = tests::belts(30);
    for (Body& body : scene.bodies)  // none at first
        if (body.motion == Motion::dynamic) set_material(body, {});
    set_material(scene.bodies[0], {});
    scene.bodies.push_back({.motion = Motion::kinematic, .shape = Box{vec3(0.3f)}, .position = {-1, 0.4f, 0}});
    const std::size_t hand = scene.bodies.size() - 1;
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), make_device_runner(device));
    for (World* world : {&cpu, &there}) world->set_events({.contacts = true, .sensors = true});
    for (int i = 0; i < 12; ++i) {
        for (World* world : {&cpu, &there}) {
            if (i == 2) world->set_material(0, {.surface_velocity = {1, 0, 0}});
            if (i == 4) world->set_material(7, {.friction = 0.1f, .static_friction = 2});
            if (i == 6) world->set_material(0, {});
            if (i % 3 == 0)
                world->move_bodies(std::vector{BodyTarget{.body = hand,
                                                          .position = {i % 2 ? -1.0f : 1.5f, 0.4f, 0.1f * static_cast<float>(i)},
                                                          .orientation = {0, 0.1f * static_cast<float>(i), 0, 1},
                                                          .steps = 20}});
            if (i == 7) {
                const Joint hinge = world->joint_at(Ball{}, 6, 8, world->body(6).position);
                world->add_joints(std::vector{hinge, hinge});
                world->remove_joints(std::vector{world->joint_handle_of(0)});
            }
            world->step(8);
        }
        REQUIRE(there.state_hash() == cpu.state_hash());
        CHECK(there.sensed() == cpu.sensed());
        const std::vector<Event> here = cpu.take_events(), other = there.take_events();
        REQUIRE(here.size() == other.size());
        for (std::size_t k = 0; k < here.size(); ++k)
            CHECK((here[k].kind == other[k].kind && here[k].a == other[k].a && here[k].b == other[k].b &&
                   here[k].impulse == other[k].impulse));
    }
}

TEST_CASE("restitution that comes and goes gives a device the bits of the CPU, also through checkpoints and in other rows",
          "[vulkan][process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    const Scene scene = tests::heap_without_restitution();
    World here(scene, tests::coarse(), 1), there(scene, tests::coarse(), make_device_runner(device)),
        moved(scene, tests::coarse(), make_device_runner(device));
    const std::vector<std::uint64_t> expected = tests::hashes_with_late_restitution(here);
    REQUIRE(tests::hashes_with_late_restitution(there) == expected);
    REQUIRE(tests::hashes_with_late_restitution(moved, [](World& world) {
                const std::vector<std::byte> mark = world.save();
                world.step(7);
                world.restore(mark);
                world.reorder();
            }) == expected);
    CHECK(there.save() == here.save());
}
