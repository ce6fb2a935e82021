// Shapes as the inside of planes, for cutting: exactly where they have flat faces, else as a polytope around them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "compute/scene.h"

namespace scree {

// How far a checked shape reaches from its centre in a direction (of unit length), m. Not of a plane.
double reach_along(const Shape& shape, glm::dvec3 direction);

// xyz: outward, unit; w: distance from the centre, m. The wall of a cylinder or cone has 24 planes, a ball 42, or where it
// shall be `fine` 162.
std::vector<glm::dvec4> planes_of(const Shape& shape, bool fine);

}  // namespace scree
