// Triangles of a mesh or a height field, made ready for contacts: clean, and each knows how its neighbours go on.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/scene.h"

namespace scree {

struct MeshForm {
    struct Triangle {
        std::array<glm::vec3, 3> corners;  // m, from its middle
        glm::vec3 middle;                  // of the box around it, in the body's frame, m
        glm::vec3 half_extents;            // of that box, m
        glm::vec3 normal;                  // outward, unit
        float distance;                    // of its plane from the middle, along the normal, m
        // Of the edges from corner 0 to 1, 1 to 2, 2 to 0: the unit normal that leans out over it as far as a contact's may. The
        // triangle's own where the mesh goes on flat or rises, the neighbour's at a ridge, straight outward where it ends.
        std::array<glm::vec3, 3> limits;
    };
    std::vector<Triangle> triangles;
    float reach = 0;  // of the farthest corner from the body's origin, m

    std::size_t dropped = 0;    // triangles without area, or that there were twice
    std::size_t open = 0;       // edges with a triangle on one side only
    std::size_t branching = 0;  // edges with more than two triangles, or with two that face opposite ways
};

// How many of its triangles cut through another one.
std::size_t crossing_triangles(const MeshForm& form);
// What is odd about it, in words; empty if nothing is.
std::string oddities(const MeshForm& form);

// Triangles that have no mesh to simulate; what() says why, `place` which number is wrong ("/triangles/7"; may be empty).
struct MeshError : std::runtime_error {
    MeshError(std::string where, const std::string& reason) : std::runtime_error(reason), place(std::move(where)) {}
    std::string place;
};
// Of finite vertices (m). Vertices at the same place are one; triangles without area, and repeated ones, are dropped.
MeshForm mesh_form(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles);
MeshForm mesh_form(const HeightField& field);

// Of a mesh or height field that has been checked; null for other shapes.
const MeshForm* mesh_form_of(const Shape& shape);

}  // namespace scree
