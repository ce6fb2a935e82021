// The seams of a compound: which parts touch each other, as records of the table of shape data.
#pragma once

#include <vector>

#include "compute/scene.h"
#include "shaders/physics/base/records.h"

namespace scree {

// Of each part of a checked compound, in the layout of shaders/physics/collide/seam.h; empty of one without neighbours. Boxes and
// hulls alone have seams.
std::vector<std::vector<physics::uvec4>> seam_records(const Compound& compound);

}  // namespace scree
