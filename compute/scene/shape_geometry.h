// Geometry of shapes on the host: support, extents, bounding planes, ray casts. Masses: mass_properties().
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "compute/scene.h"

namespace scree {

// The size of a checked shape as in BodyProperties (SHAPE_* in shaders/physics/base/shapes.h), m.
vec3 record_size(const SimpleShape& shape);

// Support of a checked shape from its centre in a unit direction, m. Not for planes.
double reach_along(const Shape& shape, glm::dvec3 direction);

// Half extents of a shape's box about the body's origin, body axes, m; for a compound a bound. 0 for planes, meshes and
// height fields.
vec3 half_extents(const Shape& shape);

// Radius of the bounding sphere about the body's origin, m; for a compound a bound, for a plane 1.
float bounding_radius(const Shape& shape);

// Planes whose intersection is a checked convex shape, for cutting: exact for flat faces, else a polytope around it.
// xyz: outward unit normal; w: distance from the centre, m. The side of a cylinder or cone has 24 planes, a ball 42, or
// 162 if `fine`.
std::vector<glm::dvec4> planes_of(const Shape& shape, bool fine);

// Distance along a ray (unit direction) to the first surface met from outside, m; none if the ray misses the shape or
// begins in it. Back faces of planes and surfaces are ignored.
std::optional<float> ray_distance(const Shape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along);
std::optional<float> ray_distance(const SimpleShape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along);
// The same for one triangle of a mesh or height field.
std::optional<float> ray_distance(const MeshForm& form, std::size_t triangle, vec3 position, vec4 orientation, vec3 from,
                                  vec3 along);

// Whether a point is in a checked convex shape or behind a plane, the surface included.
bool contains(const SimpleShape& shape, vec3 position, vec4 orientation, vec3 point);
bool contains(const Shape& shape, vec3 position, vec4 orientation, vec3 point);  // compounds and surfaces contain none

}  // namespace scree
