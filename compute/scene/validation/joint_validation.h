// Validation of joints (compute/scene.h).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "compute/scene.h"

namespace scree {

// Normalises frames. Throws SceneError, naming the joint, for a missing body, a joint of a body with itself or between
// two bodies that never move, an axis or frame of length 0, reversed limits, and values not finite or out of range.
void check_joints(Scene& scene);
// One joint, as the scene's at that index.
void check_joint(const Scene& scene, Joint& joint, std::size_t index);

// Remarks on joints whose anchors must coincide, and are apart at the start.
void note_open_joints(const Scene& scene, std::vector<std::string>& notes);

// Keeps anchors in place after a body's frame has moved: its origin to `centre` (m), its axes along `axes` (old frame).
void shift_joints(Scene& scene, std::size_t body, const glm::dvec3& centre, const glm::dquat& axes);

}  // namespace scree
