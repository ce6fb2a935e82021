// Statistics and hash of a state on the host.
#pragma once

#include <cstdint>

#include "compute/step/state.h"
#include "compute/world.h"

namespace scree {

// `scene`: the checked scene with which the state began. Contacts are those of the last step.
Statistics statistics_of(const Scene& scene, const State& state);

// XXH64 over position, orientation, velocity and angular velocity of every body in id order; if bodies may break, also
// over which of them exist.
std::uint64_t hash_of(const State& state);

}  // namespace scree
