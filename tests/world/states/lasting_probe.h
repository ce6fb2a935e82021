// Marks in a lasting table of rows that no bookkeeping names: the strains of scenes in which nothing breaks, which no stage of
// theirs reads or writes; or a table that tests/house/add_table adds (SCREE_PROBED).
#pragma once

#include <cstddef>
#include <vector>

#include "compute/runner.h"
#include "compute/tables/state.h"
#include "compute/tables/table_ranges.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

#ifndef SCREE_PROBED
#define SCREE_PROBED strains
#endif

namespace scree::tests {

using Mark = physics::records::SCREE_PROBED;
using Marks = std::vector<Mark>;  // by id

inline TableRanges marked_range(const State& state) {
    return {{Table::SCREE_PROBED, 0, state.fixed().bodies}};
}

inline Marks marks_of(World& world) {
    const State& state = world.state();
    world.runner().download(marked_range(state));
    Marks marks(state.body_count);
    for (std::uint32_t id = 0; id < marks.size(); ++id) marks[id] = state.SCREE_PROBED[state.row_of(id)];
    return marks;
}

// Another one for each body, from `first` on.
inline void mark(World& world, std::size_t first = 1) {
    auto& state = const_cast<State&>(world.state());
    for (std::uint32_t id = 0; id < state.body_count; ++id) state.SCREE_PROBED[state.row_of(id)] = static_cast<Mark>(first + id);
    world.runner().upload(marked_range(state));
}

inline bool is_moved(World& world) {
    const State& state = world.state();
    for (std::uint32_t id = 0; id < state.body_count; ++id)
        if (state.row_of(id) != id) return true;
    return false;
}

// The marks of a world of these bodies that stays as it is, `steps` after it was marked.
inline Marks expected_marks(const Scene& scene, const Settings& settings, int steps, std::size_t first = 1) {
    World plain(scene, settings, 1);
    mark(plain, first);
    plain.step(steps);
    return marks_of(plain);
}

}  // namespace scree::tests
