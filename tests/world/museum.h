// A scene with something of everything: shapes, materials, compounds, a mesh, joints, breakable bodies, a vehicle.
#pragma once

#include "compute/scene.h"

namespace scree {
class World;
}

namespace scree::tests {

// A hull of five corners, and a compound of a box and a capsule.
Hull wedge();
Compound hammer();

// A heap of `count` bodies beside one of each other thing.
Scene museum(int count);

// Before steps 5 to 40: grips, pushes, motors, new bodies and joints, gravity, substeps, breaking, sleep.
void meddle(World& world);

}  // namespace scree::tests
