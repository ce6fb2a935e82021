// Sphere and capsule meshes, as unit directions that round.vert turns toward the camera and scales.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace scree::host {

struct RoundMesh {
    std::vector<glm::vec4> directions;   // see shaders/render/bodies/round.vert
    std::vector<std::uint32_t> indices;  // triangles, counterclockwise from outside
};

// The visible cap of a sphere with `corners` (a multiple of 4) silhouette vertices, scaled to the area of the circle.
RoundMesh sphere_mesh(int corners);
// A whole capsule with `corners` (even, at least 6) around its axis.
RoundMesh capsule_mesh(int corners);

}  // namespace scree::host
