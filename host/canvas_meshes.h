// The meshes of spheres and capsules, as directions that round.vert turns to the eye and stretches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace scree::host {

struct RoundMesh {
    std::vector<glm::vec4> directions;   // see shaders/render/round.vert
    std::vector<std::uint32_t> indices;  // triangles, counterclockwise from outside
};

// The visible cap of a sphere, with `corners` (a multiple of 4, at least 8) on its silhouette.
RoundMesh sphere_mesh(int corners);
// A whole capsule with `corners` (even, at least 6) around its axis.
RoundMesh capsule_mesh(int corners);
// How many corners a silhouette gets when so many bodies are drawn: few bodies are large in the picture, many are small.
int round_corners(std::size_t bodies);

}  // namespace scree::host
