// What a canvas knows of a scene before its first picture, on whatever it draws: instances and meshes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/canvas_plan.h"

namespace scree::host {

constexpr std::uint32_t MOST_QUADS = 1024;     // of the legend and the caption; what is more is not drawn
constexpr std::uint32_t MARKS_OF_A_TOUCH = 4;  // as many points as a Contact has room for

// Consecutive records of a table.
struct Run {
    std::uint32_t first = 0, count = 0;
};

struct Scenery {
    std::vector<std::uint32_t> instances;  // bodies, in the order of their shapes; never empty
    std::array<Run, 4> shapes;             // where spheres, capsules, boxes, planes lie in `instances`
    std::vector<glm::vec4> directions;     // corners of the meshes, see round.vert
    std::vector<std::uint32_t> indices;    // triangles: numbers of `directions`
    std::array<Run, 3> meshes;             // where each Mesh lies in `indices`

    explicit Scenery(const ShapeInstances& bodies);
    // Instances of a draw, with so many marks and quads.
    Run items(Items kind, std::uint32_t marks, std::uint32_t quads) const;
    Run mesh(Mesh of) const { return meshes[static_cast<std::size_t>(of)]; }
};

}  // namespace scree::host
