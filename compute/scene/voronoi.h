// Voronoi cells within a convex region.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace scree {

struct Region {
    std::vector<glm::dvec4> planes;  // outward unit normal; w: distance from the centre, m
    glm::dvec3 half;                 // half extents of its box, m

    bool holds(glm::dvec3 point) const;
};

struct Cell {
    std::vector<glm::dvec3> corners;
    glm::dvec3 centre;  // of its volume
};

// The cells of the points, but those without volume, in their order.
std::vector<Cell> cells_of(const Region& region, std::span<const glm::dvec3> points);

}  // namespace scree
