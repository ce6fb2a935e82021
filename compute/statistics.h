// Statistics and hash of a state on the host.
#pragma once

#include <cstdint>
#include <optional>

#include "compute/step/state.h"
#include "compute/world.h"

namespace scree {

// What is summed over the contacts of the last step.
struct ContactSums {
    std::uint64_t manifolds = 0, points = 0, penetrating = 0;  // the last one: points
    double depth = 0;                                          // of these, m, in all
    double greatest = 0, greatest_resting = 0;                 // Statistics::penetration_max, penetration_resting
};
// Over the contacts in the tables, if ranks share the world over those that this one tells of.
ContactSums contact_sums(const State& state, std::optional<std::uint32_t> copy = std::nullopt);
ContactSums operator+(const ContactSums& a, const ContactSums& b);

// `scene`: the checked scene with which the state began. `copy`: of one copy of the scene alone.
Statistics statistics_of(const Scene& scene, const State& state, const ContactSums& contacts,
                         std::optional<std::uint32_t> copy = std::nullopt);

// XXH64 over position, orientation, velocity and angular velocity of every body in id order; if bodies may break, also
// over which of them exist.
std::uint64_t hash_of(const State& state, std::optional<std::uint32_t> copy = std::nullopt);

}  // namespace scree
