// Ray casts against each kind of shape in double precision, the judge of shaders/physics/collide/ray.h.
#pragma once

#include <optional>

#include "compute/scene.h"

namespace scree::oracle {

// Distance along a ray (unit direction) to the first surface met from outside, m; none if the ray misses the shape or
// begins in it. Back faces of planes and surfaces are ignored.
std::optional<float> ray_distance(const Shape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along);
std::optional<float> ray_distance(const SimpleShape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along);

// Whether a point is in a checked convex shape or behind a plane, the surface included; none is in compounds and surfaces.
bool contains(const Shape& shape, vec3 position, vec4 orientation, vec3 point);

}  // namespace scree::oracle
