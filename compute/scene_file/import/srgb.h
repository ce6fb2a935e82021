// Colours of files in linear light, as scenes have them.
#pragma once

#include <glm/glm.hpp>

namespace scree::imports {

// Encodes linear light, IEC 61966-2-1; between 0 and 1.
glm::vec3 srgb_of(glm::vec3 linear);

}  // namespace scree::imports
