// Selects the widest SIMD stages of this processor, and what they take of a state.
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
    WideTables tables{state.words(), items.data()};
    tables.manifolds = reinterpret_cast<std::uint32_t*>(state.scratch.pair_manifolds.data());
    if (!state.bounces()) tables.impacts = nullptr;
    tables.carried = nullptr;
    tables.groups = state.scratch.lane_contacts.empty() ? nullptr : state.scratch.lane_contacts.front().words;
    tables.unloaded = state.scratch.unloaded_groups.data();
    tables.body_groups = state.scratch.lane_bodies.empty() ? nullptr : state.scratch.lane_bodies.front().words;
    tables.prefetches = state.counted().solver_contacts > most_cached_contacts;
    tables.watched = state.is_watched;
    tables.periodic = state.is_periodic();
    const SceneFeatures has = state.features();
    const bool usual = !has.bounces && !has.tyres && !has.surfaces;
    tables.plain = usual && !has.rolls;
    tables.sums_impacts = has.bounces || state.is_watched;
    tables.warm_starts = usual && !has.blocks && !has.cohesion && !state.is_watched;
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
