// Signed distances from the surface of a solid on a grid, and the nearest triangle of each grid point.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace scree {

class DistanceGrid {
public:
    // Of a closed surface about 1 wide; `cell`: width of the grid's cells. What it winds around is inside.
    DistanceGrid(const std::vector<glm::dvec3>& points, const std::vector<glm::uvec3>& triangles, double cell);

    double at(const glm::dvec3& place) const;                                    // interpolated; below 0 inside
    std::array<std::uint32_t, 8> nearest_around(const glm::dvec3& place) const;  // triangles, of the corners of its cell
    std::uint32_t nearest(const glm::dvec3& place) const;                        // triangle, about

    glm::ivec3 count() const { return count_; }
    glm::dvec3 place(int x, int y, int z) const { return low_ + cell_ * glm::dvec3(x, y, z); }
    double value(int x, int y, int z) const { return distances_[index(x, y, z)]; }
    glm::ivec3 cell_of(const glm::dvec3& place) const;  // lower corner, within the grid
    double cell() const { return cell_; }

private:
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count_.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(count_.x) +
               static_cast<std::size_t>(x);
    }
    void measure(const std::vector<glm::dvec3>& points, const std::vector<glm::uvec3>& triangles);
    void sign(const std::vector<glm::dvec3>& points, const std::vector<glm::uvec3>& triangles);

    double cell_;
    glm::dvec3 low_{0};
    glm::ivec3 count_{0};
    std::vector<double> distances_;
    std::vector<std::uint32_t> nearest_;
};

// Squared distance of a point from a triangle.
double squared_distance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace scree
