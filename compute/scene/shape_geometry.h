// What the host measures of shapes: where a ray meets them.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "compute/scene.h"

namespace scree {

// Along a ray (of unit length) to a checked shape at a pose, m: to the first surface that it meets from outside; nothing if it
// misses the shape or begins in it. From behind, planes and surfaces are not there.
std::optional<float> ray_distance(const Shape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along);

}  // namespace scree
