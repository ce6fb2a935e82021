// Validation of a scene's periodic cell, and of the bodies in it.
#pragma once

#include "compute/scene.h"

namespace scree {

// Throws SceneError for sizes and rates out of range; planes that face along a periodic axis, fixed bodies outside of the cell,
// and bodies so large that they could meet two images of one; and for a cell with joints that stretches. Bodies are checked.
void check_periodic_cell(const Scene& scene);

}  // namespace scree
