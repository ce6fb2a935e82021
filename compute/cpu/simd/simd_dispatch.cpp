// Selects the widest SIMD stages of this processor, and views a state's tables as words.
#include "compute/cpu/simd/simd_stages.h"

#include "compute/cpu/simd/simd_joints.h"
#include "compute/step/state.h"

namespace scree::reference {

WideTables wide_tables(State& state, const std::vector<std::uint32_t>& items) {
    const auto words = [](auto& table) { return reinterpret_cast<std::uint32_t*>(table.data()); };
    WideTables tables{items.data(),           words(state.parameters), words(state.properties), words(state.constraints),
                      words(state.slot_ends), words(state.poses),      words(state.velocities), words(state.masses),
                      words(state.forces),    words(state.impulses),   words(state.slots)};
    tables.impact_debts = state.impact_debts.data();
    tables.groups = state.lane_contacts.empty() ? nullptr : state.lane_contacts.front().words;
    tables.watched = state.is_watched;
    const SceneFeatures has = state.features();
    tables.plain = !has.bounces && !has.rolls && !has.tyres && !has.surfaces;
    return tables;
}

const WideStages* wide_stages(int most) {
#if defined(__x86_64__)
    if (most >= 16 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        return &wide_stages_16;
    if (most >= 8 && __builtin_cpu_supports("avx2")) return &wide_stages_8;
#endif
    return most >= 4 ? &wide_stages_4 : nullptr;
}

const WideJointStages* wide_joint_stages(int most) {
#if defined(__x86_64__)
    if (most >= 8 && __builtin_cpu_supports("avx2")) return &wide_joint_stages_avx2;
#endif
    return most >= 4 ? &wide_joint_stages_baseline : nullptr;
}

}  // namespace scree::reference
