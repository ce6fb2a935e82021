// What a canvas knows of a scene before its first picture, on whatever it draws: instances and meshes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "host/canvas_plan.h"
#include "shaders/physics/records.h"
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
    std::array<BodyRun, RUNS> runs{};    // those that are seen are empty until somebody looks
    std::vector<glm::vec4> directions;   // corners of the meshes of round bodies, see round.vert
    std::vector<std::uint32_t> indices;  // triangles, of as many bodies as are drawn together
    std::array<Run, MESHES> meshes;      // where each Mesh lies in `indices`

    explicit Scenery(const ShapeInstances& bodies);
    Run mesh(Mesh of) const { return meshes[static_cast<std::size_t>(of)]; }
    // Instances of a draw of something else than bodies, with so many marks and quads.
    Run items(Items kind, std::uint32_t marks, std::uint32_t quads) const;
    std::uint32_t bodies() const { return runs[RUN_PLANES].first; }  // but planes
    // Which bodies are seen, into `instances` and `runs`; a device does the same with shaders/render/detail_*.comp.
    void look(const Frame& frame, const physics::Traits* traits, const physics::Pose* poses);

private:
    void add_mesh(Mesh as, std::uint32_t run, std::uint32_t corners, const std::vector<std::uint32_t>& triangles,
                  const std::vector<glm::vec4>& at);
    void add_meshes();
};

// Instances that draw the bodies of a run.
constexpr std::uint32_t instances_of(const BodyRun& run) {
    return (run.count + run.together - 1) / run.together;
}

}  // namespace scree::host
