// The direction in which two overlapping convex shapes come apart soonest.
#pragma once

#include "shaders/physics/collide/distance.h"

namespace scree {

// From what a step's search found, which is a local minimum of the depth over directions: the least of a grid of directions, and
// of a descent from the best of them. Planes, triangles, and pairs for which the search is exact stay as they are.
physics::DistanceBound least_depth(const physics::BodyProperties& a, const physics::Pose& pose_a,
                                   const physics::BodyProperties& b, const physics::Pose& pose_b,
                                   const physics::DistanceBound& found, physics::Hulls hulls);

}  // namespace scree
