// Which way a shape's surface faces where a ray has met it.
#pragma once

#include "compute/ray.h"
#include "compute/scene.h"

namespace scree {

// Unit, out of the surface of a checked shape at a pose; `point` is where the ray meets it (ray_distance), m. On an edge, of a
// face that the ray can meet.
vec3 surface_normal(const Shape& shape, vec3 position, vec4 orientation, const Ray& ray, vec3 point);

}  // namespace scree
