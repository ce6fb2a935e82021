// Slices of stages on timelines.
#include "compute/plan/stage_slices.h"

namespace scree {

std::optional<std::uint32_t> items_of(const Stage& stage, const State& state) {
    const physics::Counts& counts = state.counted();
    switch (stage.domain) {
        case DispatchDomain::bodies:
            return state.fixed().bodies;
        case DispatchDomain::joint_blocks:
            return state.fixed().joint_blocks;
        case DispatchDomain::vehicles:
            return state.fixed().vehicles;
        case DispatchDomain::bonds:
            return state.fixed().bonds;
        case DispatchDomain::pairs:
            return counts.pairs;
        case DispatchDomain::pair_type:
            return counts.pair_type_first[stage.pass + 1] - counts.pair_type_first[stage.pass];
        case DispatchDomain::contacts:
            return counts.contacts;
        case DispatchDomain::solver_contacts:
            return counts.solver_contacts;
        default:
            return std::nullopt;
    }
}

void tell(Timeline& told, Timeline::Track track, const Stage& stage, const State& state, Timeline::Time begin,
          Timeline::Time end) {
    if (const std::optional<std::uint32_t> items = items_of(stage, state))
        told.slice(track, stage.name, begin, end, {{"items", static_cast<double>(*items)}});
    else
        told.slice(track, stage.name, begin, end);
}

}  // namespace scree
