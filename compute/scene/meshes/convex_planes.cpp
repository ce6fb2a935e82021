// Supporting planes of a convex shape in many directions.
#include "compute/scene/meshes/convex_planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "compute/scene/shape_geometry.h"

namespace scree {

namespace {

using glm::dvec3;

// Vertices of an icosahedron subdivided once or twice: 42 directions, or 162.
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
                // Edges of a level differ by an eighth; other distances are longer by half.
                if (glm::length(corners[i] - corners[k]) > 1.2 * edge) continue;
                corners.push_back(glm::normalize(corners[i] + corners[k]));
                shortest = std::min(shortest, glm::length(corners[i] - corners.back()));
            }
        edge = shortest;
    }
    return corners;
}

}  // namespace

void TouchingPlanes::touch(dvec3 direction) {
    const dvec3 n = glm::normalize(direction);
    planes.emplace_back(n, reach_along(shape_, n));
}

void TouchingPlanes::touch_along_axes() {
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            dvec3 direction(0);
            direction[axis] = sign;
            touch(direction);
        }
}

void TouchingPlanes::touch_around(double slope) {
    constexpr int sides = 24;
    for (int k = 0; k < sides; ++k) {
        const double angle = 2 * std::numbers::pi * k / sides;
        // Rounded to float: the last bits of sine and cosine differ between C libraries.
        touch({static_cast<float>(portable::cos(angle)), slope, static_cast<float>(portable::sin(angle))});
    }
}

void TouchingPlanes::touch_all_over(bool fine, dvec3 stretch) {
    for (const dvec3& direction : directions(fine ? 2 : 1)) touch(direction / stretch);
}

}  // namespace scree
