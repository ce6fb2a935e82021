// Validation of vehicles (compute/scene.h).
#pragma once

#include "compute/scene.h"

namespace scree {

// Call after bodies and joints are checked. Throws SceneError, naming the vehicle, for a chassis or joint that is
// missing or unsuitable, a wheel that cannot rotate or be steered, axles that are not parallel, a chassis or wheel
// shared by two vehicles, a route of one point, and values not finite or out of range.
void check_vehicles(const Scene& scene);

}  // namespace scree
