// What a canvas knows of a scene before its first picture, on whatever it draws: instances and meshes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/canvas/canvas_plan.h"
#include "shaders/render/frame.h"

namespace scree::host {

constexpr std::uint32_t MOST_QUADS = 1024;     // of the legend and the caption; what is more is not drawn
constexpr std::uint32_t MARKS_OF_A_TOUCH = 4;  // as many points as a Contact has room for

// Consecutive records of a table.
struct Run {
    std::uint32_t first = 0, count = 0;
};

struct Scenery {
    // Bodies in the order of their shapes, planes last; and behind them as much room for those that are seen.
    std::vector<std::uint32_t> instances;
    std::array<BodyRun, RUNS> runs{};    // those that are seen are empty until the device has looked
    std::vector<glm::vec4> directions;   // corners of meshes, see round.vert and solid_mesh.h
    std::vector<std::uint32_t> indices;  // triangles, of as many bodies as are drawn together
    std::array<Run, MESHES> meshes;      // where each Mesh lies in `indices`

    explicit Scenery(const ShapeInstances& bodies);
    Run mesh(Mesh of) const { return meshes[static_cast<std::size_t>(of)]; }
    // Instances of a draw of something else than bodies, with so many quads.
    Run items(Items kind, const BodyTables& tables, std::uint32_t quads) const;
    std::uint32_t bodies() const { return runs[RUN_PLANES].first; }  // but planes
    std::uint32_t records = 1;                                       // of a table of bodies

private:
    void add_mesh(Mesh as, std::uint32_t run, std::uint32_t corners, const std::vector<std::uint32_t>& triangles,
                  const std::vector<glm::vec4>& at);
    void add_meshes();
    void add_solids(const ShapeInstances& bodies);
};

// Indexed draws of the bodies that are seen, whose number of instances the device writes.
struct DrawArguments {
    std::uint32_t indices = 0, instances = 0, first_index = 0, vertex_offset = 0, first_instance = 0;
};
std::array<DrawArguments, SEEN_RUNS> arguments_of(const Scenery& scenery, const std::vector<Draw>& draws);

// What the device does before it draws: shaders of shaders/render, one thread for each body (but one group for the scan).
constexpr std::array<const char*, 4> LOOKS{"tint.comp", "detail_count.comp", "detail_scan.comp", "detail_fill.comp"};
// Workgroups of the n-th of them.
constexpr std::uint32_t groups_of_look(std::size_t n, std::uint32_t bodies) {
    return n == 2 ? 1 : (bodies + DETAIL_GROUP - 1) / DETAIL_GROUP;
}

// Instances that draw the bodies of a run.
constexpr std::uint32_t instances_of(const BodyRun& run) {
    return (run.count + run.together - 1) / run.together;
}

}  // namespace scree::host
