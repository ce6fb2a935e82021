// Random bodies of mixed shape and size, each within a given bounding sphere, so that bodies in a lattice do not
// overlap.
#pragma once

#include "compute/scene.h"
#include "demos/scenes/random.h"

namespace scree::demos {

// A body of bounding radius `reach` (m), randomly oriented.
Body random_box(float reach, Random& random);       // ratio of sides between 1 : 1 and 1 : 2
Body random_mixed(float reach, Random& random);     // half of them boxes, a quarter spheres, a quarter capsules
Body random_assorted(float reach, Random& random);  // any shape but planes, compounds included, equally likely
Body random_stone(float reach, Random& random);     // a convex hull

}  // namespace scree::demos
