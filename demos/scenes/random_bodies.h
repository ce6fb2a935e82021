// Bodies of mixed shape and size in a lattice of cells, each within its cell whichever way it is turned, so that none overlap.
#pragma once

#include "compute/scene.h"
#include "demos/scenes/random.h"

namespace scree::demos {

// A body that fits into a sphere of radius `reach` (m) about its centre, turned at random.
Body random_box(float reach, Random& random);       // sides between 1 : 1 and 1 : 2
Body random_mixed(float reach, Random& random);     // half of them boxes, a quarter spheres, a quarter capsules
Body random_assorted(float reach, Random& random);  // of any shape but planes, compounds among them, each as often
Body random_stone(float reach, Random& random);     // a hull

}  // namespace scree::demos
