// Grains that come in during a run.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "compute/grains.h"
#include "compute/world.h"

namespace scree {

constexpr std::size_t most_poured = 20'000'000;

// The grains of a description. Equal ones are made once; what nobody needed for a while is made again. Throws SceneError at the
// place, also for more than `most`.
std::shared_ptr<const GrainSupply> supply_of(const Grains& grains, const std::string& place, std::size_t most = most_poured);

// How many have come into the scene of a world, those left out included.
std::size_t poured(const Grains& grains, const Scene& scene);

// Adds the grains of a pour that begins at a time, s, which are due before the world's next step. Throws SceneError.
void pour_due(const Grains& grains, double start, World& world);

}  // namespace scree
