// Solids bounded by polygons, cut by planes. Cuts are closed exactly, whatever the shape of a section.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace scree {

// The boundary of a solid: flat facets of any number of outlines, as edges that run counter-clockwise around their inside,
// seen from outside. Every edge of a facet has its opposite in another one.
struct SolidPiece {
    struct Edge {
        std::uint32_t from, to;  // points
    };
    std::vector<Edge> edges;          // of facet after facet
    std::vector<std::uint32_t> ends;  // of each facet's edges
    std::vector<glm::dvec3> normals;  // of the facets
    void add(const glm::dvec3& normal, const std::vector<Edge>& outline);
};

struct CuttingPlane {
    glm::dvec3 normal;
    double offset;
};
// What lies below the plane and above it; new points are appended. A point in the plane counts as above.
std::pair<SolidPiece, SolidPiece> cut(const SolidPiece& piece, const CuttingPlane& plane, std::vector<glm::dvec3>& points);

double volume_of(const SolidPiece& piece, const std::vector<glm::dvec3>& points);
std::vector<std::uint32_t> points_of(const SolidPiece& piece);  // ascending
// Its connected solids. One with cavities that no cut has opened stays whole.
std::vector<SolidPiece> connected(SolidPiece piece, const std::vector<glm::dvec3>& points);

}  // namespace scree
