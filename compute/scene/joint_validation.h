// The joints of a scene under examination (compute/scene.h).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene.h"

namespace scree {

// Makes frames unit quaternions. Throws SceneError, naming the joint, for a body that is missing, a joint of a body with itself
// or between two that never move, an axis or frame without length, limits reversed, and what is not finite or out of range.
void check_joints(Scene& scene);
// One joint, as if it were the scene's at that index.
void check_joint(const Scene& scene, Joint& joint, std::size_t index);

// A body's own frame has moved: its origin to `centre`, its axes along `axes` (in the old frame). Anchors stay where they are.
void shift_joints(Scene& scene, std::size_t body, const glm::dvec3& centre, const glm::dquat& axes);

}  // namespace scree
