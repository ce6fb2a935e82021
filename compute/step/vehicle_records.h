// The vehicles of a scene as the step needs them.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/scene.h"
#include "shaders/physics/base/records.h"

namespace scree {

// Of a checked scene, in its order. `joint_records`: of each joint of the scene. Routes are added to the way points.
std::vector<physics::Vehicle> vehicle_records(const Scene& scene, const std::vector<std::uint32_t>& joint_records,
                                              std::vector<physics::WayPoint>& way_points);

vec3 axle_of(const Joint& joint);  // x axis of its frame in A: unit, to the left

}  // namespace scree
