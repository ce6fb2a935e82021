// The convex parts of a grain in the world, and how much of them is in a box or a region.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "compute/scene.h"

namespace scree {

struct Span {  // along the world's axes, m
    glm::dvec3 lower, upper;
};

// A convex part at its pose. Spheres and polyhedra are cut exactly, other shapes by points.
struct Solid {
    const Sphere* ball = nullptr;
    const Box* box = nullptr;
    const Hull* hull = nullptr;
    std::optional<Shape> other{};  // if it is none of these
    glm::dvec3 centre{0};
    glm::dmat3 axes{1};  // columns
    double volume = 0;   // m^3
    Span bounds{};
};
Solid moved(Solid solid, glm::dvec3 shift);  // m
// Of a checked body, which must stay while they are used. Sensors and drawn parts are none.
std::vector<Solid> solids_of(const Body& body, glm::dvec3 position, vec4 orientation);

// What is in a box along the world's axes, m^3.
double volume_within(const Solid& solid, const Span& box);
// What is where the function says, m^3: by the share of some thousands of points in the part.
double volume_where(const Solid& solid, const std::function<bool(glm::dvec3)>& inside);

}  // namespace scree
