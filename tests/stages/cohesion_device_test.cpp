// Cohesion on a device: the bits of the CPU after every stage.
#include <catch2/catch.hpp>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/world.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/museum.h"
#include "tests/world/sticky.h"

using namespace scree;

TEST_CASE("every stage gives the same bits on both processors where bodies of all kinds are cohesive",
          "[vulkan][process:kinds]") {
    const Watched watched;
    const Scene scene = tests::sticky(tests::museum(20), 500);
    tests::require_equal(compare_in_lockstep(scene, tests::coarse(), watched.device, 1, 40));
}

TEST_CASE("a device goes on from a checkpoint of the CPU with its bits while bodies attract each other",
          "[vulkan][process:kinds]") {
    const Watched watched;
    const Scene scene = tests::sticky(tests::belts(30), 200);
    World cpu(scene, tests::coarse(), 1), there(scene, tests::coarse(), make_device_runner(watched.device));
    cpu.step(25);
    there.restore(cpu.save());
    cpu.step(25);
    there.step(25);
    CHECK(there.state_hash() == cpu.state_hash());
}

TEST_CASE("cohesion that begins between two steps has the bits of the CPU on a device", "[vulkan][process:kinds]") {
    const Watched watched;
    const Scene scene = tests::belts(20);
    World cpu(scene, tests::coarse(), 1), there(scene, tests::coarse(), make_device_runner(watched.device));
    for (World* world : {&cpu, &there}) {
        world->step(15);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            Material material = material_of(world->scene().bodies[i]);
            material.cohesion = 200;
            world->set_material(i, material);
        }
        world->step(15);
    }
    CHECK(there.state_hash() == cpu.state_hash());
}
