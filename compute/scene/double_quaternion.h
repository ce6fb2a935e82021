// Quaternions in double precision, for work on scenes.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include "compute/scene.h"

namespace scree {

// From xyzw, not normalised.
inline glm::dquat double_quaternion(vec4 q) {
    return {q.w, q.x, q.y, q.z};
}
inline vec4 single_quaternion(const glm::dquat& q) {
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

}  // namespace scree
