// Exact distances near triangles, then nearest triangles handed on from neighbour to neighbour in two sweeps. Signs count
// crossings of rays along x.
#include "compute/scene/meshes/distance_grid.h"

#include <algorithm>
#include <cmath>

namespace scree {

namespace {

using glm::dvec3;
using glm::ivec3;
using glm::uvec3;

constexpr std::uint32_t no_triangle = ~0u;

}  // namespace

// Ericson, Real-Time Collision Detection, 5.1.5.
double squared_distance(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
    const dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const auto square = [](const dvec3& v) { return glm::dot(v, v); };
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return square(ap);
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return square(bp);
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return square(cp);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return square(ap - ab * (d1 / (d1 - d3)));
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return square(ap - ac * (d2 / (d2 - d6)));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return square(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
    const dvec3 normal = glm::cross(ab, ac);
    const double along = glm::dot(normal, ap);
    return along * along / square(normal);
}

DistanceGrid::DistanceGrid(const std::vector<dvec3>& points, const std::vector<uvec3>& triangles, double cell) : cell_(cell) {
    dvec3 lower(1e300), upper(-1e300);
    for (const uvec3& t : triangles)
        for (int k = 0; k < 3; ++k) {
            lower = glm::min(lower, points[t[k]]);
            upper = glm::max(upper, points[t[k]]);
        }
    // Off the round numbers that faces lie at.
    low_ = lower - cell * dvec3(2.3719, 2.6131, 2.4517);
    count_ = ivec3(glm::ceil((upper - low_) / cell)) + 4;
    measure(points, triangles);
    sign(points, triangles);
}

void DistanceGrid::measure(const std::vector<dvec3>& points, const std::vector<uvec3>& triangles) {
    const std::size_t all =
        static_cast<std::size_t>(count_.x) * static_cast<std::size_t>(count_.y) * static_cast<std::size_t>(count_.z);
    distances_.assign(all, 1e300);
    nearest_.assign(all, no_triangle);
    const auto squared = [&](std::uint32_t t, const dvec3& p) {
        return squared_distance(p, points[triangles[t].x], points[triangles[t].y], points[triangles[t].z]);
    };
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const dvec3 a = points[triangles[t].x], b = points[triangles[t].y], c = points[triangles[t].z];
        const ivec3 from = glm::max(ivec3(glm::floor((glm::min(a, glm::min(b, c)) - low_) / cell_)), ivec3(0));
        const ivec3 to = glm::min(ivec3(glm::ceil((glm::max(a, glm::max(b, c)) - low_) / cell_)), count_ - 1);
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y)
                for (int x = from.x; x <= to.x; ++x) {
                    const std::size_t i = index(x, y, z);
                    const double d = squared(t, place(x, y, z));
                    if (d < distances_[i]) distances_[i] = d, nearest_[i] = t;
                }
    }
    std::vector<ivec3> before;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if (z < 0 || (z == 0 && (y < 0 || (y == 0 && x < 0)))) before.emplace_back(x, y, z);
    for (const int way : {1, -1}) {
        for (std::size_t n = 0; n < all; ++n) {
            const std::size_t i = way > 0 ? n : all - 1 - n;
            const auto row = static_cast<std::size_t>(count_.x), layer = row * static_cast<std::size_t>(count_.y);
            const ivec3 at(static_cast<int>(i % row), static_cast<int>(i % layer / row), static_cast<int>(i / layer));
            const dvec3 p = place(at.x, at.y, at.z);
            std::uint32_t tried = nearest_[i];
            for (const ivec3& step : before) {
                const ivec3 from = at + way * step;
                if (from.x < 0 || from.y < 0 || from.z < 0 || from.x >= count_.x || from.y >= count_.y || from.z >= count_.z)
                    continue;
                const std::uint32_t t = nearest_[index(from.x, from.y, from.z)];
                if (t == no_triangle || t == tried) continue;
                tried = t;
                const double d = squared(t, p);
                if (d < distances_[i]) distances_[i] = d, nearest_[i] = t;
            }
        }
    }
    for (double& d : distances_) d = std::sqrt(d);
}

void DistanceGrid::sign(const std::vector<dvec3>& points, const std::vector<uvec3>& triangles) {
    std::vector<std::int32_t> windings(distances_.size());
    for (const uvec3& t : triangles) {
        const dvec3 corners[3] = {points[t[0]], points[t[1]], points[t[2]]};
        const dvec3 lower = glm::min(corners[0], glm::min(corners[1], corners[2]));
        const dvec3 upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
        const dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const ivec3 from = glm::max(ivec3(glm::floor((lower - low_) / cell_)), ivec3(0));
        const ivec3 to = glm::min(ivec3(glm::ceil((upper - low_) / cell_)), count_ - 1);
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y) {
                const dvec3 at = place(0, y, z);
                int inside = 0;  // each edge by the same sum for both of its triangles
                for (int k = 0; k < 3; ++k) {
                    const std::uint32_t i = t[k], j = t[(k + 1) % 3];
                    const dvec3 a = points[std::min(i, j)], b = points[std::max(i, j)];
                    const double turn = (b.y - a.y) * (at.z - a.z) - (b.z - a.z) * (at.y - a.y);
                    inside += ((turn >= 0) == (i < j)) ? 1 : -1;
                }
                if (inside != 3 && inside != -3) continue;
                if (normal.x == 0) continue;
                const double x = corners[0].x - ((at.y - corners[0].y) * normal.y + (at.z - corners[0].z) * normal.z) / normal.x;
                const double first = std::ceil((std::clamp(x, lower.x, upper.x) - low_.x) / cell_);
                const int column = std::clamp(static_cast<int>(first), 0, count_.x - 1);
                windings[index(column, y, z)] += inside > 0 ? -1 : 1;
            }
    }
    for (int z = 0; z < count_.z; ++z)
        for (int y = 0; y < count_.y; ++y) {
            std::int32_t winding = 0;
            for (int x = 0; x < count_.x; ++x) {
                winding += windings[index(x, y, z)];
                if (winding > 0) distances_[index(x, y, z)] *= -1;
            }
        }
}

ivec3 DistanceGrid::cell_of(const dvec3& at) const {
    return glm::clamp(ivec3(glm::floor(glm::clamp((at - low_) / cell_, dvec3(0), dvec3(count_)))), ivec3(0), count_ - 2);
}

double DistanceGrid::at(const dvec3& where) const {
    const ivec3 c = cell_of(where);
    const dvec3 part = glm::clamp((where - place(c.x, c.y, c.z)) / cell_, dvec3(0), dvec3(1));
    const auto between = [](double a, double b, double t) { return a + (b - a) * t; };
    const auto along_x = [&](int y, int z) { return between(value(c.x, y, z), value(c.x + 1, y, z), part.x); };
    const auto along_y = [&](int z) { return between(along_x(c.y, z), along_x(c.y + 1, z), part.y); };
    return between(along_y(c.z), along_y(c.z + 1), part.z);
}

std::array<std::uint32_t, 8> DistanceGrid::nearest_around(const dvec3& where) const {
    const ivec3 c = cell_of(where);
    std::array<std::uint32_t, 8> all{};
    for (int k = 0; k < 8; ++k)
        all[static_cast<std::size_t>(k)] = nearest_[index(c.x + (k & 1), c.y + (k >> 1 & 1), c.z + (k >> 2))];
    return all;
}

std::uint32_t DistanceGrid::nearest(const dvec3& where) const {
    const ivec3 c = cell_of(where + cell_ * 0.5);
    return nearest_[index(c.x, c.y, c.z)];
}

}  // namespace scree
