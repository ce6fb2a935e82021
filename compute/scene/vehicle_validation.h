// The vehicles of a scene under examination (compute/scene.h).
#pragma once

#include "compute/scene.h"

namespace scree {

// After bodies and joints. Throws SceneError, naming the vehicle, for a chassis or joint that is missing or cannot be one, a
// wheel that cannot turn or be steered, axles that point different ways, a chassis or wheel of two vehicles, a route of one
// point, and what is not finite or out of range.
void check_vehicles(const Scene& scene);

}  // namespace scree
