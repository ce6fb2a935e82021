// Planes around shapes: those of their faces, or those that touch them in many directions.
#include "compute/scene/convex_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "compute/scene/hull.h"

namespace scree {

namespace {

using glm::dvec3;

constexpr int sides = 24;  // of what is round about one axis

// The corners of an icosahedron whose triangles are parted in four, once or twice: 42 directions, or 162.
std::vector<dvec3> directions(int rounds) {
    const double g = std::numbers::phi;
    std::vector<dvec3> corners = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (dvec3& corner : corners) corner = glm::normalize(corner);
    double edge = glm::length(corners[0] - corners[1]);
    for (int round = 0; round < rounds; ++round) {
        const std::size_t count = corners.size();
        double shortest = 2;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = i + 1; k < count; ++k) {
                // Edges of a round differ by an eighth; what is not an edge is longer by half.
                if (glm::length(corners[i] - corners[k]) > 1.2 * edge) continue;
                corners.push_back(glm::normalize(corners[i] + corners[k]));
                shortest = std::min(shortest, glm::length(corners[i] - corners.back()));
            }
        edge = shortest;
    }
    return corners;
}

}  // namespace

double reach_along(const Shape& shape, dvec3 n) {
    const double across = std::hypot(n.x, n.z);
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return static_cast<double>(sphere->radius);
    if (const auto* box = std::get_if<Box>(&shape)) return glm::dot(glm::abs(n), dvec3(box->half_extents));
    if (const auto* capsule = std::get_if<Capsule>(&shape))
        return static_cast<double>(capsule->radius) + std::abs(n.y) * static_cast<double>(capsule->half_height);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
        return across * static_cast<double>(cylinder->radius) + std::abs(n.y) * static_cast<double>(cylinder->half_height);
    if (const auto* cone = std::get_if<Cone>(&shape))
        return std::max(0.75 * static_cast<double>(cone->height) * n.y,
                        across * static_cast<double>(cone->radius) - 0.25 * static_cast<double>(cone->height) * n.y);
    double most = 0;
    if (const auto* hull = std::get_if<Hull>(&shape))
        for (const dvec3& vertex : hull->form->vertices) most = std::max(most, glm::dot(vertex, n));
    return most;
}

std::vector<glm::dvec4> planes_of(const Shape& shape, bool fine) {
    std::vector<glm::dvec4> planes;
    const auto touch = [&](dvec3 direction) {
        const dvec3 n = glm::normalize(direction);
        planes.emplace_back(n, reach_along(shape, n));
    };
    const auto around = [&](double slope) {
        for (int k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            // As floats: the last bits of sines and cosines differ between C libraries.
            touch({static_cast<float>(std::cos(angle)), slope, static_cast<float>(std::sin(angle))});
        }
    };
    if (const auto* hull = std::get_if<Hull>(&shape)) {
        for (const HullForm::Face& face : hull->form->faces) planes.emplace_back(face.normal, face.distance);
    } else if (std::holds_alternative<Box>(shape)) {
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                dvec3 direction(0);
                direction[axis] = sign;
                touch(direction);
            }
    } else if (std::holds_alternative<Cylinder>(shape)) {
        around(0);
        touch({0, 1, 0});
        touch({0, -1, 0});
    } else if (const auto* cone = std::get_if<Cone>(&shape)) {
        around(static_cast<double>(cone->radius) / static_cast<double>(cone->height));
        touch({0, -1, 0});
    } else {
        for (const dvec3& direction : directions(fine ? 2 : 1)) touch(direction);
    }
    return planes;
}

}  // namespace scree
