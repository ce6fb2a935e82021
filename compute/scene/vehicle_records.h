// Vehicle records of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/scene.h"
#include "shaders/physics/base/records.h"

namespace scree {

// The vehicles of a checked scene, in order. `joint_records`: record index by joint. Appends routes to `way_points`.
std::vector<physics::Vehicle> vehicle_records(const Scene& scene, const std::vector<std::uint32_t>& joint_records,
                                              std::vector<physics::WayPoint>& way_points);

vec3 axle_of(const Joint& joint);  // x axis of its frame in A: unit, points left

}  // namespace scree
