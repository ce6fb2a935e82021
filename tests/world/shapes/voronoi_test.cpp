// Voronoi cells: they fill their region, hold their points, and are what is nearest to these.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/voronoi.h"

namespace {

using glm::dvec3;
using scree::Cell;
using scree::Region;

dvec3 in_cube(std::mt19937& random) {
    const auto part = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    const double x = part(), y = part(), z = part();
    return {x, y, z};
}

// A ball of facets, cut off at half its height.
Region faceted(int planes) {
    Region region{{}, dvec3(1)};
    std::mt19937 random(7);
    while (static_cast<int>(region.planes.size()) < planes) {
        const dvec3 way = in_cube(random);
        if (glm::length(way) < 1 && glm::length(way) > 0.1) region.planes.emplace_back(glm::normalize(way), 1);
    }
    region.planes.emplace_back(0, 1, 0, 0.5);
    return region;
}

double volume_of(const Cell& cell) {
    std::vector<glm::vec3> points(cell.corners.begin(), cell.corners.end());
    return scree::hull_form(points).volume;
}

std::vector<dvec3> points_in(const Region& region, std::size_t count) {
    std::mt19937 random(11);
    std::vector<dvec3> points;
    while (points.size() < count) {
        const dvec3 point = in_cube(random);
        if (region.holds(point)) points.push_back(point);
    }
    return points;
}

}  // namespace

TEST_CASE("Voronoi cells fill their region, and each corner is nearest to the cell's own point") {
    const Region region = faceted(24);
    const double whole = volume_of(scree::cells_of(region, std::vector<dvec3>{dvec3(0)}).at(0));
    for (const std::size_t count : {2u, 5u, 60u, 256u}) {
        const std::vector<dvec3> points = points_in(region, count);
        const std::vector<Cell> cells = scree::cells_of(region, points);
        REQUIRE(cells.size() == count);
        double all = 0;
        for (std::size_t i = 0; i < count; ++i) {
            all += volume_of(cells[i]);
            for (const dvec3& corner : cells[i].corners) {
                const double own = glm::length(corner - points[i]);
                for (const dvec3& other : points) CHECK(own <= glm::length(corner - other) + 1e-9);
                for (const glm::dvec4& plane : region.planes) CHECK(glm::dot(dvec3(plane), corner) <= plane.w + 1e-9);
            }
        }
        CHECK(all == Approx(whole).epsilon(1e-4));  // hulls merge faces that are nearly in one plane
    }
}

TEST_CASE("Voronoi cells of a grid of points in a box are boxes, whose planes meet in their corners") {
    const Region region{{}, dvec3(1.0 / 1.001)};
    std::vector<dvec3> points;
    for (int k = 0; k < 64; ++k) points.push_back(dvec3(k % 4, k / 4 % 4, k / 16) * 0.5 - 0.75);
    const std::vector<Cell> cells = scree::cells_of(region, points);
    REQUIRE(cells.size() == 64);
    for (std::size_t i = 0; i < 64; ++i) {
        CHECK(glm::length(cells[i].centre - points[i]) < 1e-12);
        CHECK(volume_of(cells[i]) == Approx(0.125).epsilon(1e-5));
    }
}

TEST_CASE("points outside of their region, and one that coincides with another, have cells or none, and end") {
    const Region region = faceted(10);
    CHECK(scree::cells_of(region, std::vector<dvec3>{dvec3(5, 0, 0), dvec3(0)}).size() == 1);
    CHECK(scree::cells_of(region, std::vector<dvec3>{dvec3(0.1), dvec3(0.1)}).size() == 2);
    CHECK(scree::cells_of(region, {}).empty());
}
