// Geometry of a canvas, independent of the graphics API: instances and meshes, built once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/canvas/canvas_plan.h"
#include "shaders/render/frame.h"

namespace scree::host {

constexpr std::uint32_t MOST_QUADS = 1024;     // capacity for legend and caption; further quads are not drawn
constexpr std::uint32_t MARKS_OF_A_TOUCH = 4;  // points of a Contact

// A range of records in a table.
struct Run {
    std::uint32_t first = 0, count = 0;
};

struct Scenery {
    // Row indices of bodies grouped by shape, planes last; followed by equal space for the visible bodies, filled on
    // the device.
    std::vector<std::uint32_t> instances;
    std::array<BodyRun, RUNS> runs{};    // the SEEN_RUNS are empty until the level-of-detail shaders have run
    std::vector<glm::vec4> directions;   // vertices, see round.vert and solid_mesh.h
    std::vector<std::uint32_t> indices;  // triangles, repeated for each body of a batch
    std::array<Run, MESHES> meshes;      // range of each Mesh in `indices`

    explicit Scenery(const ShapeInstances& bodies);
    Run mesh(Mesh of) const { return meshes[static_cast<std::size_t>(of)]; }
    // Instances of a draw of items other than bodies; `quads` is the number of overlay quads.
    Run items(Items kind, const BodyTables& tables, std::uint32_t quads) const;
    std::uint32_t bodies() const { return runs[RUN_PLANES].first; }  // bodies that are no planes
    std::uint32_t records = 1;                                       // rows of the body tables
    bool textured = false;                                           // solids have surfaces
    std::vector<std::uint32_t> texels;                               // texels_of() their textures

private:
    void add_mesh(Mesh as, std::uint32_t run, std::uint32_t corners, const std::vector<std::uint32_t>& triangles,
                  const std::vector<glm::vec4>& at);
    void add_meshes();
    void add_solids(const ShapeInstances& bodies);
};

// Arguments of an indirect indexed draw (VkDrawIndexedIndirectCommand); `instances` is written on the device.
struct DrawArguments {
    std::uint32_t indices = 0, instances = 0, first_index = 0, vertex_offset = 0, first_instance = 0;
};
std::array<DrawArguments, SEEN_RUNS> arguments_of(const Scenery& scenery, const std::vector<Draw>& draws);

// Compute shaders of shaders/render that run before drawing, one thread per body (the scan: one workgroup).
constexpr std::array<const char*, 4> LOOKS{"tint.comp", "detail_count.comp", "detail_scan.comp", "detail_fill.comp"};
// Workgroups of the n-th of these shaders.
constexpr std::uint32_t groups_of_look(std::size_t n, std::uint32_t bodies) {
    return n == 2 ? 1 : (bodies + DETAIL_GROUP - 1) / DETAIL_GROUP;
}

// Instances needed for a run, with `together` bodies in each.
constexpr std::uint32_t instances_of(const BodyRun& run) {
    return (run.count + run.together - 1) / run.together;
}

}  // namespace scree::host
