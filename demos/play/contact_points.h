// The contact points of one body, for display.
#pragma once

#include <vector>

#include "compute/world.h"

namespace scree::demos {

struct ContactPoint {
    std::size_t other = 0;  // body
    vec3 position{0};       // m
    vec3 normal{0};         // unit, towards the body
    float force = 0;        // N, normal force in the last substep; 0 if speculative
};

// Reads all contacts. Throws std::out_of_range.
std::vector<ContactPoint> contact_points_of(const World& world, std::size_t body);

}  // namespace scree::demos
