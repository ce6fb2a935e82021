// The solid that a mesh encloses, for its convex parts: closed, turned out, and its volume and inertia.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compute/scene/meshes/decomposition.h"

namespace scree::decomposition {

using glm::dvec3;
using glm::uvec3;

// A mesh of size 1 about the middle of its box, without open edges.
struct Solid {
    std::vector<dvec3> points;
    std::vector<uvec3> triangles;
    dvec3 middle{0};
    double size = 1;  // m
    std::size_t closed = 0;
    bool inside_out = false;
};

// Throws DecompositionError if the mesh encloses no volume.
Solid solid_of(std::span<const vec3> vertices, std::span<const uvec3> given);
dvec3 normal_of(const Solid& solid, const uvec3& triangle);
// Volume, centre, inertia and what was closed.
void integrate(const Solid& solid, ConvexParts& made);

}  // namespace scree::decomposition
