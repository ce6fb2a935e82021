// Validation of bonds, and their places.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene.h"

namespace scree {

// Places bonds that have no length. Throws SceneError, naming the bond, for a missing body, a bond of a body with itself, of two
// bodies that never move, or of more than fit on a body, and values not finite or out of range.
void check_bonds(Scene& scene);
// Keeps placed bonds in place after a body's frame has moved: its origin to `centre` (m), its axes along `axes` (old frame).
void shift_bonds(Scene& scene, std::size_t body, const glm::dvec3& centre, const glm::dquat& axes);

// Of the ball that has the volume of a checked body, m; 0: it has none.
double radius_as_ball(const Body& body);

}  // namespace scree
