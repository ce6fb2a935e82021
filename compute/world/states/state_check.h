// Checks of the tables in a checkpoint: what a step would read beyond a table, or without end.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/tables/state.h"
#include "compute/world/states/edited_tables.h"

namespace scree {

// What a checkpoint says of a state.
struct SavedTables : EditedTables {
    const physics::Parameters& parameters;
    const physics::Counts& counts;
    std::uint32_t body_count = 0;
    const std::vector<std::uint32_t>& rows;  // by id; empty: equal to the ids
    StartLengths at_start;
    RecordBytes<physics::BodyProperties> properties{};
    RecordBytes<physics::Pose> poses{};
    RecordBytes<physics::Velocity> velocities{};
    RecordBytes<physics::uint> first_contacts{};
    RecordBytes<physics::Contact> contacts{};
};

// Throws CheckpointError, which names the table and the record, where an index, a count or a list leads out of its table or
// into a circle, and where a body is nowhere. `own`: the state that is to take the tables, from whose scene they are.
void check_tables(const SavedTables& saved, const State& own);

}  // namespace scree
