// Instances and meshes of a canvas, independent of the graphics API.
#include "host/canvas/draw_geometry.h"

#include <algorithm>
#include <numeric>

#include "host/canvas/meshes.h"

namespace scree::host {
namespace {

// Minimum vertices per instance; with fewer, a software renderer is dominated by per-instance overhead.
constexpr std::uint32_t CORNERS_OF_AN_INSTANCE = 512;
constexpr int SPHERE_CORNERS[SPHERE_DETAILS] = {64, 24, 8, 4};
constexpr int CAPSULE_CORNERS[CAPSULE_DETAILS] = {32, 12, 6};

// Triangles of the three visible faces of a box. Corner k lies on the near side of axis i if bit i of k + 1 is set;
// counterclockwise from outside if the near sides are +x, +y, +z.
const std::vector<std::uint32_t> BOX_TRIANGLES{0, 2, 6, 0, 6, 4, 1, 5, 6, 1, 6, 2, 3, 4, 6, 3, 6, 5};

Mesh nth(Mesh first, std::uint32_t n) {
    return static_cast<Mesh>(static_cast<std::uint32_t>(first) + n);
}

}  // namespace

Scenery::Scenery(const ShapeInstances& bodies) {
    std::uint32_t run = RUN_ALL_SPHERES;
    for (const auto* list : {&bodies.spheres, &bodies.capsules, &bodies.boxes, &bodies.solids, &bodies.planes}) {
        runs[run].first = static_cast<std::uint32_t>(instances.size());
        runs[run++].count = static_cast<std::uint32_t>(list->size());
        instances.insert(instances.end(), list->begin(), list->end());
    }
    if (!instances.empty()) records = *std::max_element(instances.begin(), instances.end()) + 1;
    instances.resize(std::max<std::size_t>(2 * instances.size(), 1));
    for (BodyRun& each : runs) each.together = each.corners = 1;
    add_meshes();
    add_solids(bodies);
    for (const std::uint32_t lines : {RUN_ARROWS, RUN_CUBES}) {
        runs[lines] = {0, runs[RUN_PLANES].first, lines == RUN_ARROWS ? ARROW_CORNERS : CUBE_CORNERS, 1, 0, 0, 0, 0};
        runs[lines].together = CORNERS_OF_AN_INSTANCE / runs[lines].corners;
    }
}

void Scenery::add_mesh(Mesh as, std::uint32_t run, std::uint32_t corners, const std::vector<std::uint32_t>& triangles,
                       const std::vector<glm::vec4>& at) {
    const std::uint32_t together = std::max(1u, CORNERS_OF_AN_INSTANCE / corners);
    runs[run].corners = corners;
    runs[run].together = together;
    runs[run].directions = static_cast<std::uint32_t>(directions.size());
    directions.insert(directions.end(), at.begin(), at.end());
    meshes[static_cast<std::size_t>(as)] = {static_cast<std::uint32_t>(indices.size()),
                                            together * static_cast<std::uint32_t>(triangles.size())};
    for (std::uint32_t body = 0; body < together; ++body) {
        for (const std::uint32_t corner : triangles) indices.push_back(body * corners + corner);
    }
}

void Scenery::add_meshes() {
    const auto add_round = [&](Mesh as, std::uint32_t run, const RoundMesh& mesh) {
        add_mesh(as, run, static_cast<std::uint32_t>(mesh.directions.size()), mesh.indices, mesh.directions);
    };
    for (std::uint32_t k = 0; k < SPHERE_DETAILS; ++k)
        add_round(nth(Mesh::sphere_0, k), RUN_SPHERES + k, sphere_mesh(SPHERE_CORNERS[k]));
    for (std::uint32_t k = 0; k < CAPSULE_DETAILS; ++k)
        add_round(nth(Mesh::capsule_0, k), RUN_CAPSULES + k, capsule_mesh(CAPSULE_CORNERS[k]));
    // Boxes and discs have no vertices in `directions`: their vertex numbers begin at 0.
    add_mesh(Mesh::box, RUN_BOXES, 7, BOX_TRIANGLES, {});
    runs[RUN_BOXES].directions = 0;
    std::vector<std::uint32_t> squares;
    for (std::uint32_t first = 0; first < 12; first += 4) {
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) squares.push_back(first + corner);
        if (first == 0) add_mesh(Mesh::disc, RUN_ALL_SPHERES, 4, squares, {});
    }
    add_mesh(Mesh::discs, RUN_ALL_CAPSULES, 12, squares, {});
    runs[RUN_ALL_SPHERES].directions = runs[RUN_ALL_CAPSULES].directions = 0;
    const BodyRun& box = runs[RUN_BOXES];
    runs[RUN_ALL_BOXES].corners = box.corners;
    runs[RUN_ALL_BOXES].together = box.together;
    if (directions.empty()) directions.emplace_back(0);
}

// Layout as in shaders/render/bodies/solid_mesh.h. Every body is drawn with the vertex count of the largest mesh.
void Scenery::add_solids(const ShapeInstances& bodies) {
    std::vector<glm::vec4> table(bodies.solids.empty() ? 0 : records);
    std::vector<std::size_t> begins;
    std::size_t most = 3;
    for (const SolidMesh& mesh : bodies.meshes) {
        begins.push_back(table.size());
        most = std::max(most, mesh.corners.size() / 2);
        table.insert(table.end(), mesh.corners.begin(), mesh.corners.end());
    }
    for (std::size_t i = 0; i < bodies.solids.size(); ++i) {
        const std::uint32_t mesh = bodies.solid_meshes.at(i);
        table[bodies.solids[i]] = {begins[mesh], bodies.meshes[mesh].corners.size() / 2, bodies.meshes[mesh].stretched, 0};
    }
    std::vector<std::uint32_t> triangles(most);
    std::iota(triangles.begin(), triangles.end(), 0u);
    add_mesh(Mesh::solid, RUN_SOLIDS, static_cast<std::uint32_t>(most), triangles, table);
    const BodyRun& seen = runs[RUN_SOLIDS];
    BodyRun& all = runs[RUN_ALL_SOLIDS];
    all.corners = seen.corners;
    all.together = seen.together;
    all.directions = seen.directions;
}

std::array<DrawArguments, SEEN_RUNS> arguments_of(const Scenery& scenery, const std::vector<Draw>& draws) {
    std::array<DrawArguments, SEEN_RUNS> arguments{};
    for (const Draw& draw : draws) {
        if (draw.items != Items::bodies || draw.run >= SEEN_RUNS) continue;
        const Run mesh = scenery.mesh(draw.mesh);
        arguments[draw.run].indices = mesh.count;
        arguments[draw.run].first_index = mesh.first;
    }
    return arguments;
}

Run Scenery::items(Items kind, const BodyTables& tables, std::uint32_t quads) const {
    switch (kind) {
        case Items::planes:
            return {runs[RUN_PLANES].first, runs[RUN_PLANES].count};
        case Items::marks:
            return {0, MARKS_OF_A_TOUCH * tables.touch_count};
        case Items::joints:
            return {0, tables.joint_count};
        case Items::quads:
            return {0, quads};
        case Items::one:
        case Items::bodies:
            break;
    }
    return {0, 1};
}

}  // namespace scree::host
