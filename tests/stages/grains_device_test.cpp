// Grains that come in during a run: the same bits on a device, and of a state that goes from one to the other on the way.
#include <catch2/catch.hpp>

#include "compute/device/make_device_runner.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/rain.h"

using namespace scree;

TEST_CASE("poured grains have the same bits on a device, also when it takes over on the way", "[process:changes]") {
    const Watched watched;
    const SceneDocument document = scene_from_json(tests::rain(R"("count": 60, "count_rate": 100)"));
    World here(document.scene, {}, 1), there(document.scene, {}, make_device_runner(watched.device));
    const auto step = [&](World& world) {
        perform_due(document.events, world);
        world.step();
    };
    std::vector<std::byte> saved;
    for (int i = 0; i < 45; ++i) {
        step(here);
        step(there);
        if (i == 20) saved = here.save();
        CAPTURE(i);
        REQUIRE(here.scene().bodies.size() == there.scene().bodies.size());
        if (i % 6 == 0) REQUIRE(here.state_hash() == there.state_hash());
    }
    REQUIRE(here.scene().bodies.size() == document.scene.bodies.size() + 60);
    const std::uint64_t end = here.state_hash();
    REQUIRE(there.state_hash() == end);
    there.restore(saved);
    for (int i = 21; i < 45; ++i) step(there);
    REQUIRE(there.state_hash() == end);
}
