// Cells of the grid as bodies come: they fit them, and follow from the state alone, wherever it is and whenever it was saved.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/on_ranks.h"
#include "tests/world/rain.h"

using namespace scree;
using tests::Lines;

namespace {

// Five bodies and ten grains more every six steps: their number doubles in steps 6, 12, 18 and 36, and 72.
SceneDocument rain() {
    return scene_from_json(tests::rain(R"("count": 120, "count_rate": 100)"));
}

void step(const SceneDocument& document, World& world) {
    perform_due(document.events, world);
    world.step();
}

float cell_of(const World& world) {
    return world.state().fixed().cell;
}

}  // namespace

TEST_CASE("cells of the grid fit bodies that come into an empty world, and few pairs are looked at", "[grains]") {
    const SceneDocument document = rain();
    World world(document.scene);
    CHECK(cell_of(world) == 1);
    for (int i = 0; i < 80; ++i) step(document, world);
    REQUIRE(world.scene().bodies.size() == 125);
    CHECK(cell_of(world) < 0.2f);  // grains are 0.05 to 0.09 m wide
    CHECK(cell_of(world) > 0.05f);
    // As if all had been there at first.
    Scene all = world.scene();
    CHECK(cell_of(world) == Approx(cell_of(World(all))).epsilon(0.3));
}

TEST_CASE("a pour that is saved before and after each doubling goes on with the same bits", "[grains]") {
    const SceneDocument document = rain();
    World world(document.scene);
    std::map<int, std::vector<std::byte>> saved;
    std::map<int, float> cells;
    int chosen = 0;
    for (int i = 0; i < 80; ++i) {
        if (i % 6 <= 1) {
            saved[i] = world.save();
            cells[i] = cell_of(world);
        }
        const float before = cell_of(world);
        step(document, world);
        chosen += cell_of(world) != before;
    }
    CHECK(chosen >= 3);
    const std::uint64_t end = world.state_hash();
    World other(document.scene);
    for (const auto& [steps, bytes] : saved) {
        CAPTURE(steps);
        other.restore(bytes);
        CHECK(cell_of(other) == cells[steps]);
        for (int i = steps; i < 80; ++i) step(document, other);
        REQUIRE(cell_of(other) == cell_of(world));
        REQUIRE(other.state_hash() == end);
    }
}

TEST_CASE("a pour that goes back over a doubling chooses the same cells again", "[grains]") {
    const SceneDocument document = rain();
    World world(document.scene);
    for (int i = 0; i < 11; ++i) step(document, world);
    const float before = cell_of(world);
    world.keep_state();
    for (int i = 0; i < 9; ++i) step(document, world);
    const float after = cell_of(world);
    const std::uint64_t end = world.state_hash();
    REQUIRE(after != before);
    for (int round = 0; round < 2; ++round) {
        world.roll_back(9);
        CHECK(cell_of(world) == before);
        for (int i = 0; i < 9; ++i) step(document, world);
        CHECK(cell_of(world) == after);
        CHECK(world.state_hash() == end);
    }
}

TEST_CASE("a pour on several ranks has the cells and the bits of one", "[grains][ranks]") {
    const SceneDocument document = rain();
    const tests::TellingScript script = [&](World& world) {
        Lines lines;
        for (int i = 0; i < 40; ++i) {
            step(document, world);
            if (i % 6 == 0)
                lines.push_back(fmt::format("{} bodies, cells of {:a}, {}", world.scene().bodies.size(), cell_of(world),
                                            hash_text(world.state_hash())));
        }
        return lines;
    };
    const Lines expected = tests::told_by_one(document.scene, script);
    for (const int ranks : {2, 3}) tests::check_alike(tests::told_by_ranks(ranks, document.scene, script), expected);
}
