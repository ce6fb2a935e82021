// Brute-force pairs of overlapping AABBs in double precision, the reference of the broadphase.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <set>
#include <utility>
#include <vector>

#include "compute/scene.h"

namespace scree::oracle {

struct Bounds {
    glm::dvec3 low;   // m
    glm::dvec3 high;  // m
};

// AABB of a body at its pose in the scene, widened by `margin` (m) on every side; infinite for planes.
Bounds bounds_of(const Body& body, double margin = 0);
std::vector<Bounds> bounds_of(const Scene& scene, double margin = 0);

// Pairs (a, b) with a < b whose bounds overlap or touch.
std::set<std::pair<std::size_t, std::size_t>> brute_force_pairs(const std::vector<Bounds>& bounds);

}  // namespace scree::oracle
