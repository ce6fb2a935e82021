// Where two bodies touch, in double precision, by the plainest geometry that is right; shares no code with the simulator.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "compute/scene.h"

namespace scree::oracle {

struct TextbookPose {
    glm::dvec3 position{0};              // of the centre of mass, m
    glm::dvec4 orientation{0, 0, 0, 1};  // unit quaternion x, y, z, w
};

// One point of contact.
struct TextbookPoint {
    glm::dvec3 position;  // midway between the surfaces, world, m
    glm::dvec3 normal;    // unit, from A to B
    double separation;    // m, < 0 inside
};

double dot_product(glm::dvec3 a, glm::dvec3 b);
glm::dvec3 cross_product(glm::dvec3 a, glm::dvec3 b);
double magnitude(glm::dvec3 a);
// The matrix that turns the body's axes to the world's; the quaternion need not be of unit length.
glm::dmat3 rotation_matrix(glm::dvec4 quaternion);

// Points nearer than `reach` (m). Knows every pair of sphere, capsule, box and plane but box with box, for which it throws
// std::invalid_argument, as it does for two planes.
std::vector<TextbookPoint> textbook_points(const Shape& a, const TextbookPose& pose_a, const Shape& b, const TextbookPose& pose_b,
                                           double reach);

}  // namespace scree::oracle
