// Ranges of the tables by purpose.
#include "compute/tables/table_ranges.h"

#include <algorithm>
#include <tuple>

namespace scree {

namespace {

TableRange live_range(const State& state, Table table) {
    return {table, 0, state.live(table_infos()[static_cast<std::size_t>(table)].length)};
}

}  // namespace

TableLengths TableLengths::of(const State& state) {
    TableLengths lengths;
    for (std::size_t i = 0; i < table_count; ++i) lengths.bytes[i] = state.raw_bytes(static_cast<Table>(i));
    lengths.features = state.features();
    lengths.blocks = state.fixed().joint_blocks;
    return lengths;
}

std::size_t bytes_of(const TableRanges& ranges) {
    std::size_t sum = 0;
    for (const TableRange& range : ranges) sum += range.count * table_infos()[static_cast<std::size_t>(range.table)].record_bytes;
    return sum;
}

void append(TableRanges& ranges, const TableRanges& more) {
    ranges.insert(ranges.end(), more.begin(), more.end());
}

TableRanges united(TableRanges ranges) {
    std::sort(ranges.begin(), ranges.end(),
              [](const TableRange& a, const TableRange& b) { return std::tie(a.table, a.first) < std::tie(b.table, b.first); });
    TableRanges found;
    for (const TableRange& range : ranges) {
        if (found.empty() || found.back().table != range.table || found.back().first + found.back().count < range.first)
            found.push_back(range);
        else
            found.back().count = std::max(found.back().count, range.first + range.count - found.back().first);
    }
    return found;
}

void append_rows(TableRanges& ranges, std::size_t first, std::size_t count) {
    for (const Table table : row_tables) ranges.push_back({table, first, count});
}

TableRanges body_ranges(const State& state) {
    TableRanges ranges;
    for (const Table table : {Table::poses, Table::velocities, Table::sleep_states}) ranges.push_back(live_range(state, table));
    if (state.changes_motions()) ranges.push_back(live_range(state, Table::properties));
    return ranges;
}

TableRanges row_ranges(const State& state, std::uint32_t row) {
    TableRanges ranges{{Table::poses, row, 1}, {Table::velocities, row, 1}, {Table::sleep_states, row, 1}};
    if (state.changes_motions()) ranges.push_back({Table::properties, row, 1});
    return ranges;
}

TableRanges contact_ranges(const State& state) {
    TableRanges ranges;
    for (const Table table : {Table::contacts, Table::impulses}) ranges.push_back(live_range(state, table));
    if (state.reordered()) ranges.push_back(live_range(state, Table::first_contacts));  // contacts_by_id
    if (state.features().convex) ranges.push_back(live_range(state, Table::pairs));     // traffic_of() counts their hulls
    return ranges;
}

TableRanges joint_ranges(const State& state) {
    if (!state.has_joints()) return {};
    return {{Table::joints, 0, state.joints.size()}};
}

TableRanges joint_structure_ranges(const State& state) {
    TableRanges ranges;
    if (!state.bonds.empty()) ranges.push_back({Table::bonds, 0, state.bonds.size()});
    if (state.has_joints())
        append(ranges,
               {{Table::joint_blocks, 0, state.joint_blocks.size()}, {Table::block_bodies, 0, state.block_bodies.size()}});
    return ranges;
}

TableRanges bond_ranges(const State& state) {
    if (state.bonds.empty()) return {};
    return {{Table::bond_states, 0, state.bonds.size()}};
}

TableRanges vehicle_ranges(const State& state) {
    return {{Table::vehicles, 0, state.fixed().vehicles}};
}

TableRanges lasting_ranges(const State& state) {
    TableRanges ranges;
    for (const Table table : row_tables) ranges.push_back(live_range(state, table));
    for (const Table table : contact_tables) ranges.push_back(live_range(state, table));
    ranges.push_back(live_range(state, Table::first_contacts));
    append(ranges, joint_ranges(state));
    append(ranges, vehicle_ranges(state));
    append(ranges, bond_ranges(state));
    return ranges;
}

}  // namespace scree
