// Lasting tables of rows on a device: their records go wherever their bodies go.
#include <catch2/catch.hpp>

#include "compute/device/make_device_runner.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/states/lasting_probe.h"

using namespace scree;

TEST_CASE("lasting tables: a device moves records with their bodies, and keeps them for rollback", "[vulkan][process:stages]") {
    const Watched watched;
    const Scene scene = tests::swarm(300, 0.5f);
    World world(scene, tests::coarse(), make_device_runner(watched.device));
    tests::mark(world);
    world.step(5);
    world.reorder();
    world.step(5);
    REQUIRE(tests::is_moved(world));
    const tests::Marks then = tests::marks_of(world);
    CHECK(then == tests::expected_marks(scene, tests::coarse(), 10));
    world.keep_state();
    world.step(5);
    tests::mark(world, 1000);
    world.roll_back(5);
    CHECK(tests::marks_of(world) == then);
}
