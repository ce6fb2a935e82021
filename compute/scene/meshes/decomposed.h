// Bodies of convex parts in place of meshes, and the parts of equal meshes, made once.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "compute/scene/meshes/decomposition.h"
#include "compute/scene/validation/shape_validation.h"

namespace scree {

// decompose() of a mesh, or what it made before: in this process, or kept in a file (decomposition_cache.h).
std::shared_ptr<const ConvexParts> convex_parts(std::span<const vec3> vertices, std::span<const glm::uvec3> triangles,
                                                const Decomposition& wanted);

// Who is told of decompositions that take more than half a second: with a text and what is done, 0 to 1. Of the process.
void tell_of_decompositions(std::function<void(const std::string&, double)> tell);

// Whether decompositions are to be stopped, asked many times a second: convex_parts() then throws. Of the process.
void stop_decompositions_if(std::function<bool()> stop);
struct DecompositionStopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// In words, with its defects.
std::string summary_of(const ConvexParts& made);
// The parts in the mesh's frame, with the mesh as their skin.
Compound compound_of(const ConvexParts& made, std::shared_ptr<const Mesh> skin);

// A body whose mesh is to be parts becomes their compound, with the mesh's mass unless it has its own. Throws SceneError.
void decompose_mesh(const Examination& body, Body& b, CheckedShapes& shapes, std::vector<std::string>* notes);

}  // namespace scree
