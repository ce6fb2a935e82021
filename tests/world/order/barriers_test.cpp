// Barriers and persistent tables, as derived from the stage declarations.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/plan/plan.h"
#include "compute/plan/stage_fusion.h"
#include "compute/tables/table_layout.h"

using namespace scree;

namespace {

std::vector<SceneFeatures> all_contents() {
    std::vector<SceneFeatures> all;
    for (std::uint32_t bits = 0; bits < 1u << 12; ++bits) {
        const auto has = [&](std::uint32_t bit) { return (bits >> bit & 1u) != 0; };
        all.push_back({has(0), has(1), has(2), has(3), has(4), has(5), has(6), has(7), has(8), has(9), has(10), has(11)});
    }
    return all;
}

using Names = std::set<std::string>;
Names without_barrier(const std::vector<Stage>& stages) {
    Names names;
    for (std::size_t i = 0; i + 1 < stages.size(); ++i)
        if (!stages[i].barrier_after) names.insert(stages[i].name + " | " + stages[i + 1].name);
    return names;
}

}  // namespace

TEST_CASE("barriers: a step waits wherever a stage needs what one before it has written") {
    for (const SceneFeatures& features : all_contents()) {
        const std::vector<Stage> stages = plan(2, features);
        REQUIRE(stages.back().barrier_after);
        for (std::size_t i = 0, first = 0; i < stages.size(); ++i) {
            for (std::size_t before = first; before < i; ++before) {
                INFO(stages[before].name << " and " << stages[i].name);
                if (conflict(stages[before], stages[i])) FAIL("may run at the same time");
            }
            if (stages[i].barrier_after) first = i + 1;
        }
    }
}

TEST_CASE("barriers: only stages that do not disturb each other run side by side") {
    CHECK(without_barrier(plan(3, {})).empty());
    Names joined;
    for (const std::string& names : without_barrier(plan(3, SceneFeatures::everything())))
        if (!names.starts_with("collide_")) joined.insert(names);
    // Other stages share the buffer of words.
    CHECK(joined == Names{"begin_step | enter_cell", "prepare_contacts | prepare_joints"});
}

TEST_CASE("barriers: stages that are several in turn wait for each other") {
    physics::Parameters small{};
    small.contact_capacity = 100;
    for (const Stage& stage : fused(plan(64, {}), small, 8))
        if (!stage.reference) CHECK(stage.barrier_after);
}

TEST_CASE("a table lasts from step to step if something reads it before it is written anew") {
    const std::vector<Table>& lasting = lasting_tables();
    using enum Table;
    CHECK(std::set<Table>(lasting.begin(), lasting.end()) ==
          std::set{parameters,   counts,       properties, poses,           velocities,      masses,         sleep_states,
                   strains,      hulls,        parts,      fractures,       pieces,          tyres,          surfaces,
                   immersions,   way_points,   filters,    exclusions,      joints,          vehicles,       ids,
                   joint_blocks, block_bodies, actions,    contacts_before, impulses_before, impacts_before, first_contacts,
                   births,       gravities,    bonds,      bond_states,     bond_ends});
}

TEST_CASE("tables in one memory take turns: none is read after another has been written there") {
    for (const SceneFeatures& features : all_contents()) {
        std::map<Table, Table> holders;  // which table is in a memory
        for (const Table table : lasting_tables()) holders[memory_of(table)] = table;
        for (const Stage& stage : plan(2, features)) {
            const auto writes = [&](Table table, Manner manner) {
                return std::any_of(stage.writes.begin(), stage.writes.end(),
                                   [&](const Access& write) { return write.table == table && write.manner == manner; });
            };
            for (const Access& read : stage.reads) {
                const auto holder = holders.find(memory_of(read.table));
                INFO(stage.name << " reads " << table_infos()[static_cast<std::size_t>(read.table)].name);
                // What a stage accumulates it begins itself.
                if (holder != holders.end() && holder->second != read.table && !writes(read.table, Manner::unfinished))
                    FAIL("holds another table");
                for (const Access& write : stage.writes)
                    if (write.table != read.table && share_memory(write.table, read.table)) FAIL("is overwritten meanwhile");
            }
            for (const Access& write : stage.writes) holders[memory_of(write.table)] = write.table;
        }
        using enum Table;
        for (const Table table : {contacts, impulses}) CHECK(holders[memory_of(table)] == table);
    }
}

TEST_CASE("what is compared after a stage is whole there, and every table that outlasts a step is compared once it is written") {
    std::set<Table> compared;
    for (const Stage& stage : plan(2, SceneFeatures::everything()))
        for (const Compared& each : stage.compared) compared.insert(each.table);
    using enum Table;
    for (const Table table :
         {counts,         properties,       poses,       velocities,     masses,        forces,     bounds,        cell_ends,
          cell_entries,   pair_type_starts, pair_starts, pairs,          pairs_by_type, strains,    contact_slots, point_counts,
          contact_starts, contacts,         impulses,    first_contacts, slot_ends,     slot_sides, constraints,   slots,
          sleep_states,   joints,           vehicles})
        CHECK(compared.contains(table));
}

TEST_CASE("a stage that is not declared has no place in the plan") {
    REQUIRE_THROWS_AS(stage_declaration("solve_everything"), std::logic_error);
}
