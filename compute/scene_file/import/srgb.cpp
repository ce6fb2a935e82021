// Colours of linear light as sRGB.
#include "compute/scene_file/import/srgb.h"

#include <algorithm>

#include "compute/scene/portable_math.h"

namespace scree::imports {

glm::vec3 srgb_of(glm::vec3 linear) {
    for (int k = 0; k < 3; ++k) {
        const float x = std::clamp(linear[k], 0.0f, 1.0f);
        linear[k] = x <= 0.0031308f ? 12.92f * x : 1.055f * portable::pow(x, 1.0f / 2.4f) - 0.055f;
    }
    return linear;
}

}  // namespace scree::imports
