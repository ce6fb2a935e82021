// Selects the widest SIMD stages of this processor, and views a state's tables as words.
#include "compute/cpu/simd/simd_stages.h"

#include <algorithm>

#include "compute/cpu/simd/simd_blocks.h"
#include "compute/cpu/simd/simd_joints.h"
#include "compute/parallel/threads.h"
#include "compute/tables/state.h"

namespace scree::reference {

namespace {

constexpr std::uint32_t most_cached_contacts = 6000;  // take 1.7 MB as groups
constexpr std::size_t least_blocks = 2;               // one is solved faster by itself

// Lanes of the widest stages with at most `most`; 1: none.
int widest(int most) {
    const int lanes = std::min(most, widest_lanes());
    return lanes >= 16 ? 16 : lanes >= 8 ? 8 : lanes >= 4 ? 4 : 1;
}

}  // namespace

WideTables wide_tables(State& state, const std::vector<std::uint32_t>& items) {
    const auto words = [](auto& table) { return reinterpret_cast<std::uint32_t*>(table.data()); };
    WideTables tables{};
    tables.items = items.data();
    tables.parameters = words(state.parameters);
    tables.properties = words(state.properties);
    tables.slot_ends = words(state.slot_ends);
    tables.contacts_before = words(state.contacts_before);
    tables.impulses_before = words(state.impulses_before);
    tables.contact_pairs = state.contact_pairs.data();
    tables.contact_slots = state.contact_slots.data();
    tables.pairs = words(state.pairs);
    tables.manifolds = words(state.scratch.pair_manifolds);
    tables.point_counts = words(state.point_counts);
    tables.contacts = words(state.contacts);
    tables.constraints = words(state.constraints);
    tables.bounds = words(state.bounds);
    tables.poses = words(state.poses);
    tables.velocities = words(state.velocities);
    tables.masses = words(state.masses);
    tables.forces = words(state.forces);
    tables.impulses = words(state.impulses);
    tables.impacts = state.bounces() ? words(state.impacts) : nullptr;
    tables.slots = words(state.slots);
    tables.impact_debts = state.impact_debts.data();
    tables.groups = state.scratch.lane_contacts.empty() ? nullptr : state.scratch.lane_contacts.front().words;
    tables.unloaded = state.scratch.unloaded_groups.data();
    tables.body_groups = state.scratch.lane_bodies.empty() ? nullptr : state.scratch.lane_bodies.front().words;
    tables.prefetches = state.counted().solver_contacts > most_cached_contacts;
    tables.watched = state.is_watched;
    const SceneFeatures has = state.features();
    const bool usual = !has.bounces && !has.tyres && !has.surfaces;
    tables.plain = usual && !has.rolls;
    tables.sums_impacts = has.bounces || state.is_watched;
    tables.warm_starts = usual && !has.blocks && !state.is_watched;
    if (tables.warm_starts && !has.breaking) tables.constraints = nullptr;
    return tables;
}

const WideStages* wide_stages(int most) {
#if SCREE_WIDEST_LANES >= 16
    if (widest(most) == 16) return &wide_stages_16;
#endif
#if SCREE_WIDEST_LANES >= 8
    if (widest(most) == 8) return &wide_stages_8;
#endif
    return widest(most) == 4 ? &wide_stages_4 : nullptr;
}

const WideBlockStages* wide_block_stages(std::size_t blocks, int most) {
    if (blocks < least_blocks) return nullptr;
#if SCREE_WIDEST_LANES >= 16
    if (widest(most) == 16 && blocks > 8) return &wide_block_stages_16;
#endif
#if SCREE_WIDEST_LANES >= 8
    if (widest(most) >= 8 && blocks > 4) return &wide_block_stages_8;
#endif
    return widest(most) >= 4 ? &wide_block_stages_4 : nullptr;
}

const WideJointStages* wide_joint_stages(int most) {
#if SCREE_WIDEST_LANES >= 8
    if (widest(most) >= 8) return &wide_joint_stages_avx2;
#endif
    return widest(most) >= 4 ? &wide_joint_stages_baseline : nullptr;
}

}  // namespace scree::reference
