// Tables in device buffers: memory of their own, or shared with a table that is dead by then.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <utility>

#include "compute/tables/table_layout.h"

using namespace scree;

namespace {

Scene everything_that_has_tables() {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    Compound dumbbell;
    dumbbell.parts.push_back({.shape = Sphere{0.3f}, .position = {-0.5f, 0, 0}});
    dumbbell.parts.push_back({.shape = Sphere{0.3f}, .position = {0.5f, 0, 0}});
    scene.bodies.push_back({.shape = dumbbell, .position = {0, 2, 0}});
    scene.bodies.push_back({.shape = Cylinder{0.4f, 0.1f}, .position = {0, 4, 0}, .tyre = Tyre{}});
    return scene;
}

// Whether the two tables share memory, directly or through others.
bool take_turns(const std::string& one, const std::string& other) {
    static const auto owners = [] {
        std::map<std::string, std::string> all;
#define SCREE_SHARE(later, earlier) all[#later] = #earlier;
        SCREE_SHARES(SCREE_SHARE)
#undef SCREE_SHARE
        return all;
    }();
    const auto owner_of = [](std::string name) {
        while (owners.contains(name)) name = owners.at(name);  // carried shares with contact_starts, and that with another
        return name;
    };
    return owner_of(one) == owner_of(other);
}

}  // namespace

TEST_CASE("tables that share a buffer share no byte, unless one is dead when the other is written") {
    const State state(checked(everything_that_has_tables()), Settings{}, 64, true);
    const TableOffsets& offsets = table_offsets(state);
    const auto end_of = [&](std::size_t i) {
        return offsets.begin[i] + state.allocated(table_infos()[i].length) * table_infos()[i].record_bytes;
    };
    for (std::size_t i = 0; i < table_count; ++i) {
        const TableInfo& one = table_infos()[i];
        INFO(one.name);
        const std::size_t buffer = buffer_of(static_cast<Table>(i));
        CHECK(end_of(i) <= offsets.bytes[buffer]);
        CHECK(offsets.begin[i] % buffer_infos()[buffer].record_bytes == 0);
        for (std::size_t k = 0; k < i; ++k) {
            const TableInfo& other = table_infos()[k];
            if (buffer != buffer_of(static_cast<Table>(k))) continue;
            INFO(other.name);
            const bool apart = offsets.begin[i] >= end_of(k) || offsets.begin[k] >= end_of(i);
            CHECK(apart != take_turns(one.name, other.name));
        }
    }
}

TEST_CASE("a step leaves at least four of the 32 storage buffers that lavapipe binds") {
    REQUIRE(buffer_count - 1 <= 28);
}

TEST_CASE("parts lie where the scene says, and their rows have no mass of their own") {
    const State state(checked(everything_that_has_tables()), Settings{}, 64, true);
    const std::uint32_t first = state.fixed().first_part;
    REQUIRE(state.parts.size() == 2);
    CHECK(state.part_in(first).position.x < 0);
    CHECK(state.part_in(first + 1).position.x > 0);
    for (std::uint32_t row = first; row < state.fixed().bodies; ++row) {
        CHECK(state.properties[row].inverse_mass == 0);
        CHECK(state.properties[row].inverse_inertia == vec3(0));
        CHECK(state.properties[row].owner == 1);
    }
}
