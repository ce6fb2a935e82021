// The volume of a ball within a box, exactly.
#pragma once

#include <glm/glm.hpp>

namespace scree {

// The box is given by its corners from the ball's centre, m; lower is not above upper.
double ball_in_box(double radius, glm::dvec3 lower, glm::dvec3 upper);

}  // namespace scree
