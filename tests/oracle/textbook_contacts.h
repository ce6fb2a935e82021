// Contact points in double precision by elementary geometry; shares no code with the simulator.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "compute/scene.h"

namespace scree::oracle {

struct TextbookPose {
    glm::dvec3 position{0};              // centre of mass, m
    glm::dvec4 orientation{0, 0, 0, 1};  // unit quaternion x, y, z, w
};

// A contact point.
struct TextbookPoint {
    glm::dvec3 position;  // midway between the surfaces, world, m
    glm::dvec3 normal;    // unit, from A to B
    double separation;    // m, < 0 inside
};

double dot_product(glm::dvec3 a, glm::dvec3 b);
glm::dvec3 cross_product(glm::dvec3 a, glm::dvec3 b);
double magnitude(glm::dvec3 a);
// Rotation matrix from body to world axes; the quaternion need not be normalised.
glm::dmat3 rotation_matrix(glm::dvec4 quaternion);

// Contact points with a separation below `reach` (m), for pairs of sphere, capsule, box and plane. Throws
// std::invalid_argument for other shapes, two boxes and two planes.
std::vector<TextbookPoint> textbook_points(const Shape& a, const TextbookPose& pose_a, const Shape& b, const TextbookPose& pose_b,
                                           double reach);

}  // namespace scree::oracle
