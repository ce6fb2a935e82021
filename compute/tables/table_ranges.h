// Ranges of tables, for transfers between a state and its runner.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compute/tables/lasting.h"
#include "compute/tables/state.h"

namespace scree {

struct TableRange {
    Table table;
    std::size_t first = 0;  // record
    std::size_t count = 0;  // number of records
};
using TableRanges = std::vector<TableRange>;

// Lengths of all tables, and what else a runner adapts to.
struct TableLengths {
    std::array<std::size_t, table_count> bytes{};
    SceneFeatures features;
    std::uint32_t blocks = 0;
    static TableLengths of(const State& state);
    bool operator==(const TableLengths&) const = default;
};

std::size_t bytes_of(const TableRanges& ranges);
void append(TableRanges& ranges, const TableRanges& more);
TableRanges united(TableRanges ranges);  // the same records, each once
// Appends the same rows of each of row_tables.
void append_rows(TableRanges& ranges, std::size_t first, std::size_t count);

// Ranges between two steps, with the runner's counts: poses, velocities and sleep states of all rows (and motions, if
// bodies may break); of one row; contacts of the last step; all joints; all vehicles.
TableRanges body_ranges(const State& state);
TableRanges row_ranges(const State& state, std::uint32_t row);
TableRanges contact_ranges(const State& state);
TableRanges joint_ranges(const State& state);
TableRanges vehicle_ranges(const State& state);
TableRanges bond_ranges(const State& state);  // which are broken
// Of joint blocks and bonds, which only edits and reordering change.
TableRanges joint_structure_ranges(const State& state);
// All lasting data that the host does not know by itself.
TableRanges lasting_ranges(const State& state);

}  // namespace scree
