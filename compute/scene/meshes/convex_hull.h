// Convex hull of points with a limit of corners, in double precision and a fixed order: the same bits on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace scree {

struct ConvexHull {
    struct Plane {
        glm::dvec3 normal;  // outward, unit
        double offset;      // of the plane along it
    };
    std::vector<std::uint32_t> corners;               // indices of points, ascending
    std::vector<std::array<std::uint32_t, 3>> faces;  // indices of points, counter-clockwise from outside
    std::vector<Plane> planes;                        // of the faces
    double volume = 0;
    bool empty() const { return faces.empty(); }  // the points are flat
};

// Of points that are about 1 wide. Farthest points come first, and after `most` corners, or with none farther out than
// `within`, the rest is left out.
ConvexHull convex_hull(std::span<const glm::dvec3> points, std::size_t most, double within = 1e-5);

}  // namespace scree
