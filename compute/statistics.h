// Sums, extremes and the hash of a state on the host.
#pragma once

#include <cstdint>

#include "compute/step/state.h"
#include "compute/world.h"

namespace scree {

// `scene` is the checked scene that the state began as. Contacts are those of the last step.
Statistics statistics_of(const Scene& scene, const State& state);

// XXH64 over position, orientation, velocity and angular velocity of every body, in id order.
std::uint64_t hash_of(const State& state);

}  // namespace scree
