// Replaying a recording, and checking a run against it.
#include "compute/replay/replay.h"

#include <algorithm>
#include <stdexcept>

namespace scree::replay {

void require_start(const Input& input, const World& world) {
    if (world.steps() != 0 || !input.start_hash || *input.start_hash == world.state_hash()) return;
    throw SceneError("/start_hash", input.scene + " began in state " + hash_text(*input.start_hash) + ", here in " +
                                        hash_text(world.state_hash()) + ": it is not the scene that was recorded");
}

void perform_due(const Input& input, World& world) {
    const auto earlier = [](const TimedAct& act, std::uint64_t step) { return act.step < step; };
    auto act = std::lower_bound(input.acts.begin(), input.acts.end(), world.steps(), earlier);
    for (; act != input.acts.end() && act->step == world.steps(); ++act) {
        const auto refuse = [&](const std::exception& error) {
            throw SceneError("/acts/" + std::to_string(act - input.acts.begin()), error.what());
        };
        try {
            perform(act->act, world);
        } catch (const std::logic_error& error) {  // std::invalid_argument, std::out_of_range, std::length_error
            refuse(error);
        } catch (const SceneError& error) {
            refuse(error);
        }
    }
}

}  // namespace scree::replay
