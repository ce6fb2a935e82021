// Reference scans: standard algorithms, in place of three device stages each.
#include <algorithm>
#include <numeric>

#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"

namespace scree::reference {

namespace {

// Exclusive prefix sum, in place, with the total behind the last item.
void scan_in_place(std::vector<physics::uint>& list, std::size_t items) {
    list[items] = 0;
    std::exclusive_scan(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(items) + 1, list.begin(), 0u);
}

}  // namespace

void scan_nothing(State&, const Threads&, std::uint32_t) {}

void scan_cells_offsets(State& state, const Threads&, std::uint32_t) {
    scan_in_place(state.cell_ends, physics::buckets_in_all(state.fixed()));
}

void scan_pairs_spine(State& state, const Threads&, std::uint32_t) {
    const auto end = state.pair_starts.begin() + state.fixed().bodies;
    state.counted() = physics::with_pairs(state.counted(), std::accumulate(state.pair_starts.begin(), end, 0u), state.fixed());
}
void scan_pairs_offsets(State& state, const Threads&, std::uint32_t) {
    scan_in_place(state.pair_starts, state.fixed().bodies);
}

void scan_pair_types_offsets(State& state, const Threads&, std::uint32_t) {
    scan_in_place(state.pair_type_starts, physics::PAIR_TYPES * physics::pair_blocks_of(state.counted().pairs));
}

void scan_contacts_spine(State& state, const Threads&, std::uint32_t) {
    const auto end = state.point_counts.begin() + state.counted().pairs;
    const auto total = std::count_if(state.point_counts.begin(), end, physics::has_points);
    state.counted() = physics::with_contacts(state.counted(), static_cast<physics::uint>(total), state.fixed());
}
void scan_contacts_offsets(State& state, const Threads&, std::uint32_t) {
    const auto end = state.point_counts.begin() + state.counted().pairs;
    std::transform(state.point_counts.begin(), end, state.contact_starts.begin(),
                   [](physics::uint points) { return physics::has_points(points) ? 1u : 0u; });
    scan_in_place(state.contact_starts, state.counted().pairs);
}

void scan_slots_offsets(State& state, const Threads&, std::uint32_t) {
    scan_in_place(state.slot_ends, state.fixed().bodies);
}

}  // namespace scree::reference
