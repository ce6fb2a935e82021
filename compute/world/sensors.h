// What overlaps the sensors of a world.
#pragma once

#include <vector>

#include "compute/events.h"
#include "compute/step/state.h"
#include "compute/step/threads.h"

namespace scree {

bool has_sensors(const State& state);
// Ascending. The poses of all rows must be up to date.
std::vector<SensorOverlap> overlaps_of_sensors(const State& state, const Threads& threads);

}  // namespace scree
