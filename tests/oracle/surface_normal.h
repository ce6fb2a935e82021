// Surface normal at a ray's hit.
#pragma once

#include "compute/ray.h"
#include "compute/scene.h"

namespace scree::oracle {

// Outward unit normal of a checked shape at a pose; `point`: the hit of the ray (ray_distance), m. On an edge, the
// normal of a face that the ray can hit.
vec3 surface_normal(const Shape& shape, vec3 position, vec4 orientation, const Ray& ray, vec3 point);
vec3 surface_normal(const SimpleShape& shape, vec3 position, vec4 orientation, const Ray& ray, vec3 point);

}  // namespace scree::oracle
