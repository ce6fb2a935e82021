// The cells of the broadphase as the CPU loops read them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#include "compute/tables/state.h"
#include "shaders/physics/collide/grid.h"

namespace scree::reference {

inline physics::CellEntry entry_of(const State& state, std::uint32_t row) {
    const physics::Bounds& bounds = state.bounds[row];
    return {bounds.lower, row, bounds.upper, physics::level_of_entry(bounds.level, state.properties[row])};
}

inline std::span<const physics::CellEntry> entries(const State& state, std::size_t first, std::size_t last) {
    return std::span(state.cell_entries).subspan(first, last - first);
}

inline std::span<const physics::CellEntry> bucket(const State& state, std::size_t b) {
    return entries(state, b == 0 ? 0 : state.cell_ends[b - 1], state.cell_ends[b]);
}

// physics::boxes_overlap of bounds, entries or boxes, without branches: half of the neighbours overlap, which no branch predictor
// foresees.
template <typename A, typename B>
bool overlap(const A& a, const B& b) {
    using Four [[gnu::vector_size(16)]] = float;  // a bound and the integer behind it
    using Halves [[gnu::vector_size(16)]] = std::uint64_t;
    static_assert(sizeof(A) >= 2 * sizeof(Four) && sizeof(B) >= 2 * sizeof(Four));
    Four lower_a, upper_a, lower_b, upper_b;
    std::memcpy(&lower_a, &a.lower, sizeof lower_a);
    std::memcpy(&upper_a, &a.upper, sizeof upper_a);
    std::memcpy(&lower_b, &b.lower, sizeof lower_b);
    std::memcpy(&upper_b, &b.upper, sizeof upper_b);
    const Halves both = (Halves)((lower_a <= upper_b) & (lower_b <= upper_a));
    return (both[0] & (both[1] | 0xFFFFFFFF00000000u)) == ~std::uint64_t{0};
}

// Calls visit(entries) for the bodies in a row of cells along x, whose buckets may wrap round the end of the grid. `level`:
// with the copy.
template <typename Visit>
void for_each_in_row(const State& state, physics::ivec3 from, std::uint32_t cells, std::uint32_t level, const Visit& visit) {
    const std::uint32_t buckets = state.fixed().buckets;
    const auto end_of = [&](std::uint32_t b) { return b == 0 ? 0 : state.cell_ends[b - 1]; };
    if (cells >= buckets) return visit(entries(state, 0, end_of(buckets)));
    const std::uint32_t first = physics::bucket_of(from, level, buckets);
    const std::uint32_t last = std::min(first + cells, buckets);
    visit(entries(state, end_of(first), end_of(last)));
    if (first + cells > buckets) visit(entries(state, 0, end_of(first + cells - buckets)));
}

// Whether the entry's cell, which is noted with it, is in the row of cells along x: others are hashed to the same buckets.
struct RowOfCells {
    const State& state;
    physics::ivec3 from;
    const physics::ivec3& cell_of(const physics::CellEntry& entry) const {
        return state.scratch.entry_cells[static_cast<std::size_t>(&entry - state.cell_entries.data())];
    }
    bool has(const physics::ivec3& cell) const { return (int{cell.y == from.y} & int{cell.z == from.z}) != 0; }
};

inline std::uint32_t key_of(const physics::CellEntry& entry) {
    return entry.level & ~(physics::INACTIVE | physics::MOVES);
}

// Calls visit(entry) for the entries of a level in a range of cells; of a scene without copies.
template <typename Visit>
void for_each_in_cells(const State& state, const physics::CellRange& range, std::uint32_t level, const Visit& visit) {
    const auto cells = static_cast<std::uint32_t>(range.last.x - range.first.x + 1);
    RowOfCells row{state, range.first};
    const auto visit_row = [&](std::span<const physics::CellEntry> found) {
        for (const physics::CellEntry& entry : found)
            if (int{key_of(entry) == level} & int{row.has(row.cell_of(entry))}) visit(entry);
    };
    for (row.from.z = range.first.z; row.from.z <= range.last.z; ++row.from.z)
        for (row.from.y = range.first.y; row.from.y <= range.last.y; ++row.from.y)
            for_each_in_row(state, row.from, cells, level, visit_row);
}

}  // namespace scree::reference
