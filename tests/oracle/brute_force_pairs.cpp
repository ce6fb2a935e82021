// AABBs from the shapes' supports along the axes, and the double loop over pairs.
#include "tests/oracle/brute_force_pairs.h"

#include <cmath>
#include <limits>

#include "tests/oracle/textbook_contacts.h"

namespace scree::oracle {

Bounds bounds_of(const Body& body, double margin) {
    const double infinity = std::numeric_limits<double>::infinity();
    if (std::holds_alternative<Plane>(body.shape)) return {glm::dvec3(-infinity), glm::dvec3(infinity)};

    const glm::dmat3 turn = rotation_matrix(glm::dvec4(body.orientation));
    glm::dvec3 reach(margin);
    for (int axis = 0; axis < 3; ++axis) {
        if (const auto* sphere = std::get_if<Sphere>(&body.shape)) reach[axis] += sphere->radius;
        if (const auto* capsule = std::get_if<Capsule>(&body.shape)) {
            reach[axis] += capsule->radius + std::abs(turn[1][axis]) * capsule->half_height;
        }
        if (const auto* box = std::get_if<Box>(&body.shape)) {
            for (int side = 0; side < 3; ++side) reach[axis] += std::abs(turn[side][axis]) * box->half_extents[side];
        }
    }
    return {glm::dvec3(body.position) - reach, glm::dvec3(body.position) + reach};
}

std::vector<Bounds> bounds_of(const Scene& scene, double margin) {
    std::vector<Bounds> bounds;
    for (const Body& body : scene.bodies) bounds.push_back(bounds_of(body, margin));
    return bounds;
}

std::set<std::pair<std::size_t, std::size_t>> brute_force_pairs(const std::vector<Bounds>& bounds) {
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < bounds.size(); ++a) {
        for (std::size_t b = a + 1; b < bounds.size(); ++b) {
            bool apart = false;
            for (int axis = 0; axis < 3; ++axis) {
                apart = apart || bounds[a].high[axis] < bounds[b].low[axis] || bounds[b].high[axis] < bounds[a].low[axis];
            }
            if (!apart) pairs.emplace(a, b);
        }
    }
    return pairs;
}

}  // namespace scree::oracle
