// Collision triangles of a mesh or height field: welded, cleaned, with contact limits at shared edges.
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
        std::array<glm::vec3, 3> corners;  // m, from `middle`
        glm::vec3 middle;                  // centre of its box, body frame, m
        glm::vec3 half_extents;            // half extents of that box, m
        glm::vec3 normal;                  // outward unit normal
        float distance;                    // distance of its plane from `middle` along the normal, m
        // Of the edges from corner 0 to 1, 1 to 2, 2 to 0: the limit unit normal, the farthest that a contact normal
        // may lean out over the edge (triangle.h). The triangle's own at a flat or concave edge, the neighbour's at a
        // convex one, straight outward at an open one.
        std::array<glm::vec3, 3> limits;
    };
    std::vector<Triangle> triangles;
    float reach = 0;  // distance of the farthest vertex from the body's origin, m

    std::size_t dropped = 0;    // degenerate or repeated triangles
    std::size_t open = 0;       // edges of a single triangle
    std::size_t branching = 0;  // non-manifold edges: more than two triangles, or opposite orientation
};

// Number of triangles that intersect another one.
std::size_t crossing_triangles(const MeshForm& form);
// Remarks on its defects; empty if there are none.
std::string oddities(const MeshForm& form);

// Triangles without a usable mesh; what() gives the reason, `place` the wrong value ("/triangles/7"; may be empty).
struct MeshError : std::runtime_error {
    MeshError(std::string where, const std::string& reason) : std::runtime_error(reason), place(std::move(where)) {}
    std::string place;
};
// From finite vertices (m) and indices; throws MeshError. Coincident vertices are welded; degenerate and repeated
// triangles are dropped.
MeshForm mesh_form(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles);
MeshForm mesh_form(const HeightField& field);
// The triangles that mesh_form() keeps, with the first of the vertices at each place. Throws MeshError for what has none.
std::vector<glm::uvec3> welded_triangles(std::span<const glm::vec3> vertices, std::span<const glm::uvec3> triangles);

// Of a checked mesh or height field; null for other shapes.
const MeshForm* mesh_form_of(const Shape& shape);

}  // namespace scree
