// Errors of hulls: how far their points lie from the solid, and how deep its surface lies in them.
#include "compute/scene/meshes/hull_judge.h"

#include <algorithm>
#include <cmath>

namespace scree::decomposition {

namespace {

using glm::ivec3;

// Calls visit(point) over a triangle, at most `spacing` apart.
template <class Visit>
void sample(const dvec3& a, const dvec3& b, const dvec3& c, double spacing, const Visit& visit) {
    const double longest = std::sqrt(std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
    const int n = std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, 400);
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k <= n - i; ++k) visit(a + (b - a) * (double(i) / n) + (c - a) * (double(k) / n));
}

}  // namespace

Judge::Judge(const Solid& solid, double error, Effort& effort)
    : solid_(solid),
      effort_(effort),
      grid_(solid.points, solid.triangles, std::clamp(error * 0.8, 1.0 / 110, 1.0 / 50)),
      spacing_(error * 0.8) {
    for (const uvec3& t : solid.triangles) {
        const dvec3 a = solid.points[t.x], b = solid.points[t.y], c = solid.points[t.z], normal = normal_of(solid, t);
        const double area = glm::length(glm::cross(b - a, c - a)) / 2;
        // Of small triangles some, so that as many points fall on a surface of them as on one large one.
        owed_ += area / (spacing_ * spacing_ * 0.5);
        const auto take = [&](const dvec3& p) {
            if (grid_.at(p + normal * (0.7 * grid_.cell())) > 0) surface_.push_back({p, normal});
        };
        if (owed_ < 1) continue;
        if (area < spacing_ * spacing_)
            take((a + b + c) / 3.0);
        else
            sample(a, b, c, spacing_, [&](const dvec3& p) { take(p + ((a + b + c) / 3.0 - p) * 1e-3); });
        owed_ = 0;
    }
}

Error Judge::of(const ConvexHull& hull, const std::vector<dvec3>& points, double enough) const {
    std::uint64_t looked_at = 0;
    const Error error = of(hull, points, enough, looked_at);
    effort_.spend(looked_at);
    return error;
}

Error Judge::of(const ConvexHull& hull, const std::vector<dvec3>& points, double enough, std::uint64_t& looked_at) const {
    Error error;
    dvec3 lower(1e300), upper(-1e300);
    for (const std::uint32_t corner : hull.corners) {
        lower = glm::min(lower, points[corner]);
        upper = glm::max(upper, points[corner]);
    }
    const auto depth = [&](const dvec3& p, double least) {
        double depth = 1e300;
        for (const ConvexHull::Plane& plane : hull.planes) {
            ++looked_at;
            depth = std::min(depth, plane.offset - glm::dot(plane.normal, p));
            if (depth <= least) break;
        }
        return depth;
    };
    const auto outside = [&](const dvec3& p, double distance) {
        ++looked_at;
        if (distance > error.most) distance = std::min(distance, exact(p));
        if (distance > error.most) error = {distance, p, false};
    };
    for (const auto& face : hull.faces) {
        sample(points[face[0]], points[face[1]], points[face[2]], spacing_, [&](const dvec3& p) { outside(p, grid_.at(p)); });
        if (error.most > enough) return error;
    }
    const ivec3 from = grid_.cell_of(lower), to = grid_.cell_of(upper) + 1, cells = to - from + 1;
    looked_at += static_cast<std::uint64_t>(cells.x) * static_cast<std::uint64_t>(cells.y * cells.z);
    for (int z = from.z; z <= to.z; ++z)
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                if (const double distance = grid_.value(x, y, z); distance > error.most)
                    if (const dvec3 p = grid_.place(x, y, z); depth(p, 0) > 0) outside(p, distance);
    if (error.most > enough) return error;
    looked_at += surface_.size();
    for (const Sample& one : surface_) {
        const dvec3 p = one.at;
        if (p.x < lower.x || p.y < lower.y || p.z < lower.z || p.x > upper.x || p.y > upper.y || p.z > upper.z) continue;
        if (const double deep = depth(p, error.most); deep > error.most) error = {deep, p + one.normal * 1e-4, true};
    }
    return error;
}

double Judge::of_all(const std::vector<ConvexHull>& hulls, const std::vector<std::vector<dvec3>>& points) const {
    double most = 0;
    for (std::size_t i = 0; i < hulls.size(); ++i) most = std::max(most, of(hulls[i], points[i], 1e300).most);
    for (const Sample& one : surface_) {
        double least = 1e300;
        for (const ConvexHull& hull : hulls) {
            double above = -1e300;
            for (const ConvexHull::Plane& plane : hull.planes) {
                above = std::max(above, glm::dot(plane.normal, one.at) - plane.offset);
                if (above >= least) break;
            }
            least = std::min(least, above);
            if (least <= most) break;
        }
        most = std::max(most, least);
    }
    return most;
}

// From the triangles nearest to the corners of its cell: interpolation is too large at edges.
double Judge::exact(const dvec3& p) const {
    double least = 1e300;
    for (const std::uint32_t n : grid_.nearest_around(p)) {
        const uvec3& t = solid_.triangles[n];
        least = std::min(least, squared_distance(p, solid_.points[t.x], solid_.points[t.y], solid_.points[t.z]));
    }
    return std::sqrt(least);
}

CuttingPlane Judge::surface_near(const dvec3& at) const {
    const uvec3& t = solid_.triangles[grid_.nearest(at)];
    const dvec3 normal = normal_of(solid_, t);
    return {normal, glm::dot(normal, solid_.points[t.x])};
}

}  // namespace scree::decomposition
