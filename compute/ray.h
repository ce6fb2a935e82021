// A ray, and its hit: for picking and sensors.
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
    float distance = 0;   // from the ray's origin, m
    glm::vec3 point{0};   // on the surface, m
    glm::vec3 normal{0};  // unit, outward
};

}  // namespace scree
