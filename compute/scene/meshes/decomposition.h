// Convex parts of a mesh: cut by planes until every part is nearly its own hull, then merged as far as the error allows.
//
// Everything is decided in double precision and a fixed order, by one thread: the same mesh gives the same bits everywhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/shapes.h"

namespace scree {

struct ConvexParts {
    std::vector<std::vector<glm::vec3>> parts;  // corners of each, m
    // Greatest distance between the surfaces of the mesh and of the parts together, in sizes of the mesh (its longest extent);
    // sampled at a third of the error allowed.
    double error = 0;
    double hull_error = 0;  // of one hull of all
    bool enough = true;     // false: the allowed error needs more parts than are allowed
    bool given_up = false;  // cutting and merging took more than most_effort: the one part is its hull
    // Of what the triangles enclose, for density 1, in the mesh's frame.
    double volume = 0;        // m^3
    glm::dvec3 centre{0};     // m
    glm::dmat3 inertia{0};    // about the centre, m^5
    std::size_t closed = 0;   // open edges that were closed by flat lids
    std::size_t thin = 0;     // parts left out: thinner than 0.001 m, or than a thousandth of their length
    bool inside_out = false;  // faces of it, or of one of its shells, were turned
};

// A mesh that has no parts; what() gives the reason.
struct DecompositionError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// What cutting and merging may take, in distances of points that are looked at, so that it ends at one place on every machine:
// some twenty times that of any mesh of a solid that was tried, for an error of 0.02 or more; more for less. Meshes whose faces
// cross everywhere take far more.
constexpr std::uint64_t most_effort = 4'000'000'000;

// `tell` is called often, with what is done, 0 to 1; what it throws ends the work. Throws DecompositionError, and MeshError
// (mesh.h).
ConvexParts decompose(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles, const Decomposition& wanted,
                      const std::function<void(double)>& tell = {}, std::uint64_t most = most_effort);

// How far the hull of a mesh is from the mesh, in sizes of the mesh.
double hull_error(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles);

}  // namespace scree
