// Rows that are near each other, listed once for many steps.
//
// Each row of the grid has a box, its bounds of some step with a margin, and a list has the rows whose boxes overlap. While the
// bounds of two rows are within their boxes, they overlap only if the list has them, whatever bodies are in the rows by then: so
// the list need not follow edits, and pairs are those that a search finds. What has left its box is searched for in the grid;
// when that is many, boxes are drawn anew, and the list when few leave theirs within a step.
#pragma once

#include <algorithm>
#include <array>

#include "compute/cpu/cells.h"
#include "compute/parallel/threads.h"

namespace scree::reference {

// Brings the list up to date. False: it does not serve this step.
bool find_near_rows(State& state, const Threads& threads);

// Calls found(entry) for each row of the grid whose bounds overlap those of `body`: of each two for one of them.
template <typename Found>
void for_each_near(const State& state, std::uint32_t body, const Found& found) {
    using Place = NearRows::Place;
    const NearRows& near = state.scratch.near_rows;
    const physics::Bounds& around = state.bounds[body];
    if (near.places[body] == Place::in_box) {
        // Without branches: half of those near each other overlap, which no branch predictor foresees.
        std::array<std::uint32_t, 64> overlapping;
        for (std::uint32_t first = near.firsts[body]; first < near.ends[body]; first += overlapping.size()) {
            const std::uint32_t last = std::min<std::uint32_t>(first + overlapping.size(), near.ends[body]);
            std::size_t count = 0;
            for (std::uint32_t k = first; k < last; ++k) {
                overlapping[count] = near.others[k];
                count += overlap(around, near.entries[near.others[k]]);
            }
            for (std::size_t k = 0; k < count; ++k) found(near.entries[overlapping[k]]);
        }
        return;
    }
    for (std::uint32_t levels = state.counted().levels; levels != 0; levels &= levels - 1) {
        const auto level = static_cast<std::uint32_t>(std::countr_zero(levels));
        const physics::CellRange range = physics::cells_in_reach(around.lower, around.upper, level, state.fixed());
        for_each_in_cells(state, range, level, [&](const physics::CellEntry& other) {
            const bool found_by_other = near.places[other.body] == Place::outside && other.body <= body;
            if (overlap(around, other) && !found_by_other) found(other);
        });
    }
}

}  // namespace scree::reference
