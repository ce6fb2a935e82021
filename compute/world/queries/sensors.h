// What overlaps the sensors of a world, and what went through them within a step.
#pragma once

#include <span>
#include <vector>

#include "compute/events.h"
#include "compute/parallel/threads.h"
#include "compute/tables/state.h"

namespace scree {

bool has_sensors(const State& state);
// Ascending. The poses of all rows must be up to date.
std::vector<SensorOverlap> overlaps_of_sensors(const State& state, const Threads& threads);

struct Sensed {
    std::vector<SensorOverlap> now;     // ascending
    std::vector<SensorOverlap> passed;  // ascending; met within the step, at its end apart
};
// `before`: what poses_before() gave before the step.
Sensed sensed_in_step(const State& state, std::span<const physics::Pose> before, const Threads& threads);
std::vector<physics::Pose> poses_before(const State& state);  // by row; not a number for what is not there

}  // namespace scree
