// What happens to a world during a run: a script, called before every step.
#pragma once

#include <cmath>
#include <functional>

#include "compute/world.h"

namespace scree::demos {

using Script = std::function<void(World&)>;  // keeps nothing of its own: the world's time says what is due

// True before exactly one step: the first that begins at that time (s) or after it, to half a step.
inline bool is_due(const World& world, double seconds) {
    return world.steps() == static_cast<std::uint64_t>(std::llround(seconds * static_cast<double>(world.settings().rate)));
}

}  // namespace scree::demos
