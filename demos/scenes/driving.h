// Helpers for vehicle demos: way points, wedges and claims about cars.
#pragma once

#include <vector>

#include "compute/vehicle_presets.h"
#include "demos/suite/promise.h"

namespace scree::demos {

// A fixed wedge (a hull) that rises along its z axis from 0 to `rise`, beginning at `position`; lengths in m.
Body wedge(vec3 position, float width, float length, float rise, float heading);

// Rotates all bodies of a vehicle about a point.
void turn_vehicle(Scene& scene, std::size_t vehicle, vec3 pivot, vec4 turn);

Claim all_upright(const std::string& what, Indices chassis);

}  // namespace scree::demos
