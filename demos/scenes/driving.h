// What demos of vehicles have alike: roads of way points, and claims about cars.
#pragma once

#include <vector>

#include "compute/vehicle_presets.h"
#include "demos/suite/promise.h"

namespace scree::demos {

vec3 up_of(const BodyState& body);     // of a chassis: its y axis in the world
vec3 ahead_of(const BodyState& body);  // z axis

// So much a fixed wedge: a hull that rises along its z axis, from nothing to `rise`, m, in front of `position`.
Body wedge(vec3 position, float width, float length, float rise, float heading);

// All bodies of a vehicle turned about a point.
void turn_vehicle(Scene& scene, std::size_t vehicle, vec3 pivot, vec4 turn);

Claim all_upright(const std::string& what, Indices chassis);

}  // namespace scree::demos
