// Explicit mass properties of bodies: moves a body's frame to its centre of mass and principal axes.
#pragma once

#include "compute/scene/validation/shape_validation.h"

namespace scree {

// After the body's fields and shape are checked. `shape`: how the shape's own frame was moved before. Returns how the
// frame was moved in all. Checked bodies stay: checking twice changes no bit.
Shift bring_to_inertial(const Examination& body, Body& b, const Shift& shape);

}  // namespace scree
