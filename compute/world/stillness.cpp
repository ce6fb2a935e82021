// World: steps in which no body can stir, which are passed over.
#include <algorithm>
#include <cstring>
#include <utility>

#include "compute/world/world_impl.h"
#include "shaders/physics/base/work_counts.h"

namespace scree {

// Without the numbers of actions, which are of one step.
physics::Parameters World::Impl::lasting_parameters() const {
    physics::Parameters lasting = state.fixed();
    lasting.actions = lasting.redo = 0;
    return lasting;
}

// The first step without any stirring body finds contacts for the last poses, the second finds them as before: each later
// one repeats the second while nothing comes from outside.
bool World::Impl::is_still() const {
    if (still.steps < 2 || broken || !actions.empty() || !arrivals.empty() || !freed.empty() || reorder_now) return false;
    if (std::any_of(grips.begin(), grips.end(), [](const auto& grip) { return grip.has_value(); })) return false;
    const physics::Parameters now = lasting_parameters();
    return still.uploaded == runner->uploaded_bytes() && std::memcmp(&now, &still.parameters, sizeof now) == 0;
}

void World::Impl::note_stillness() {
    const Stillness found{still.steps + 1, lasting_parameters(), runner->uploaded_bytes()};
    const bool repeats =
        still.uploaded == found.uploaded && std::memcmp(&still.parameters, &found.parameters, sizeof found.parameters) == 0;
    still = found;
    if (!repeats) still.steps = 1;
    if (ranks || physics::any_stirs(state.counted()) || state.counted().broken > 0) still.steps = 0;
}

void World::Impl::pass_over(int count) {
    const std::uint64_t before = steps;
    steps += static_cast<std::uint64_t>(count);
    state.counted().steps += static_cast<std::uint32_t>(count);
    steps_ahead = true;
    if (timeline) tell_timeline(Timeline::Clock::now(), before);
}

void World::Impl::catch_up() {
    if (std::exchange(steps_ahead, false)) runner->upload({{Table::counts, 0, 1}});
}

}  // namespace scree
