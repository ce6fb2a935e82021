// Memory of the CPU loops' lists.
#include "compute/tables/cpu_scratch.h"

namespace scree {

std::size_t CpuScratch::bytes() const {
    const auto sum = [](const auto&... lists) { return (std::size_t{0} + ... + (lists.size() * sizeof lists[0])); };
    return sum(pair_manifolds, partners, entry_cells, partners_before, row_kinds, movable_bodies, driven_bodies, movable,
               fast_pairs, paces, solver_classes, lane_contacts, unloaded_groups, lane_bodies, near_rows.boxes, near_rows.firsts,
               near_rows.ends, near_rows.others, near_rows.places, near_rows.entries);
}

}  // namespace scree
