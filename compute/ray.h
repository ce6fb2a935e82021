// A ray, and the first surface that it meets: what lies under a pointer, what a sensor sees.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace scree {

struct Ray {
    glm::vec3 from{0};          // m
    glm::vec3 along{0, 0, -1};  // unit
};

struct RayHit {
    std::size_t body = 0;
    float distance = 0;   // m, along the ray
    glm::vec3 point{0};   // m, on the body's surface
    glm::vec3 normal{0};  // unit, out of the surface there
};

}  // namespace scree
