// Statistics and hash of a state on the host.
#pragma once

#include <cstdint>
#include <optional>

#include "compute/step/state.h"
#include "compute/world.h"

namespace scree {

// `scene`: the checked scene with which the state began. Contacts are those of the last step.
// `copy`: of one copy of the scene alone.
Statistics statistics_of(const Scene& scene, const State& state, std::optional<std::uint32_t> copy = std::nullopt);

// XXH64 over position, orientation, velocity and angular velocity of every body in id order; if bodies may break, also
// over which of them exist.
std::uint64_t hash_of(const State& state, std::optional<std::uint32_t> copy = std::nullopt);

}  // namespace scree
