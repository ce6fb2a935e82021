// Scripts: actions on a world during a run, called before every step.
#pragma once

#include <cmath>
#include <functional>

#include "compute/world.h"

namespace scree::demos {

using Script = std::function<void(World&)>;  // stateless: depends on the world's time alone

// True before exactly one step, the one whose start time is nearest to `seconds`.
inline bool is_due(const World& world, double seconds) {
    return world.steps() == static_cast<std::uint64_t>(std::llround(seconds * static_cast<double>(world.settings().rate)));
}

}  // namespace scree::demos
