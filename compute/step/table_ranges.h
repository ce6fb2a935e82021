// Ranges of tables: what travels between a state and the runner that it is attached to.
#pragma once

#include <cstddef>
#include <vector>

#include "compute/step/state.h"

namespace scree {

struct TableRange {
    Table table;
    std::size_t first = 0;  // record
    std::size_t count = 0;  // records
};
using TableRanges = std::vector<TableRange>;

std::size_t bytes_of(const TableRanges& ranges);
void append(TableRanges& ranges, const TableRanges& more);

// Between two steps, with the counts as they are on the runner: poses, velocities and rests of all rows, and where bodies may
// break, who is there; the same of one row; the contacts of the last step; all joints; all vehicles.
TableRanges body_ranges(const State& state);
TableRanges row_ranges(const State& state, std::uint32_t row);
TableRanges contact_ranges(const State& state);
TableRanges joint_ranges(const State& state);
TableRanges vehicle_ranges(const State& state);
// All that a step before leaves to the next, and the host does not know by itself.
TableRanges lasting_ranges(const State& state);

}  // namespace scree
