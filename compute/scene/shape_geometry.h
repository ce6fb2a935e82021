// What the host measures of shapes: how far they reach, what surrounds them, and where a ray meets them. Masses:
// mass_properties().
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "compute/scene.h"

namespace scree {

// The size of a checked shape as the records of a step have it (SHAPE_* in shaders/physics/collide/shapes.h).
vec3 record_size(const SimpleShape& shape);

// How far a checked shape reaches from its centre in a direction (of unit length), m. Not of a plane.
double reach_along(const Shape& shape, glm::dvec3 direction);

// Half of the box about the body's origin, along its axes, that holds a shape, m; of a compound a bound. 0 of planes and
// surfaces.
vec3 half_extents(const Shape& shape);

// From the body's origin to the shape's farthest point, m; of a compound a bound, of a plane 1.
float bounding_radius(const Shape& shape);

// A checked convex shape as the inside of planes, for cutting: exactly where it has flat faces, else as a polytope around it.
// xyz: outward, unit; w: distance from the centre, m. The wall of a cylinder or cone has 24 planes, a ball 42, or where it shall
// be `fine` 162.
std::vector<glm::dvec4> planes_of(const Shape& shape, bool fine);

// Along a ray (of unit length) to a checked shape at a pose, m: to the first surface that it meets from outside; nothing if it
// misses the shape or begins in it. From behind, planes and surfaces are not there.
std::optional<float> ray_distance(const Shape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along);

}  // namespace scree
