// Self-intersections of a mesh.
#include <algorithm>
#include <cstdint>
#include <numeric>

#include "compute/scene/meshes/mesh.h"

namespace scree {

namespace {

using glm::dvec3;
using Triangle = MeshForm::Triangle;

dvec3 corner(const Triangle& t, std::size_t k) {
    return dvec3(t.middle) + dvec3(t.corners[k % 3]);
}

bool share_a_corner(const Triangle& a, const Triangle& b, double within) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (glm::length(corner(a, i) - corner(b, k)) <= within) return true;
    return false;
}

// Whether an edge passes through a triangle's interior, not merely touching its plane or rim.
bool pierces(dvec3 from, dvec3 to, const Triangle& t, double within) {
    const dvec3 normal(t.normal), base = corner(t, 0);
    const double above = glm::dot(normal, from - base), below = glm::dot(normal, to - base);
    if (!((above > within && below < -within) || (above < -within && below > within))) return false;
    const dvec3 at = from + (to - from) * (above / (above - below));
    for (std::size_t k = 0; k < 3; ++k) {
        const dvec3 side = corner(t, k + 1) - corner(t, k);
        if (glm::dot(glm::cross(side, at - corner(t, k)), normal) <= within * glm::length(side)) return false;
    }
    return true;
}

bool cross(const Triangle& a, const Triangle& b, double within) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (pierces(corner(a, k), corner(a, k + 1), b, within)) return true;
        if (pierces(corner(b, k), corner(b, k + 1), a, within)) return true;
    }
    return false;
}

}  // namespace

// Sweep along x: only triangles that overlap in x are compared.
std::size_t crossing_triangles(const MeshForm& form) {
    const std::vector<Triangle>& all = form.triangles;
    const double within = 1e-6 * static_cast<double>(form.reach);
    std::vector<std::uint32_t> order(all.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto lower = [&](std::uint32_t i) { return all[i].middle.x - all[i].half_extents.x; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return lower(a) < lower(b); });
    std::vector<bool> crosses(all.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Triangle& a = all[order[i]];
        for (std::size_t k = i + 1; k < order.size() && lower(order[k]) <= a.middle.x + a.half_extents.x; ++k) {
            const Triangle& b = all[order[k]];
            const glm::vec3 apart = glm::abs(a.middle - b.middle) - (a.half_extents + b.half_extents);
            if (apart.y > 0 || apart.z > 0 || share_a_corner(a, b, within) || !cross(a, b, within)) continue;
            crosses[order[i]] = crosses[order[k]] = true;
        }
    }
    return static_cast<std::size_t>(std::count(crosses.begin(), crosses.end(), true));
}

}  // namespace scree
