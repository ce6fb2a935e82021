// Shapes as triangles for files of animations: shared where bodies are alike, scaled where that suffices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "compute/scene.h"
#include "host/files/mesh_surface.h"

namespace scree::demos {

struct Triangles {  // three corners each, counter-clockwise seen from outside
    std::vector<glm::vec3> points, normals;
    // Corners one after the other that share a material. Corners before the first are of their body; none: all.
    struct Range {
        host::SurfaceMaterial material;
        std::size_t first = 0;
    };
    std::vector<Range> ranges;
    std::vector<glm::vec2> at;          // texture coordinates of corners, if there are ranges
    std::vector<std::uint32_t> colors;  // factors of corners, packed_levels(), likewise
};

// How a body is drawn: a mesh of the collection, by index, scaled along the body's axes.
struct Drawn {
    std::size_t mesh = 0;
    glm::vec3 scale{1};
};

class MeshCollection {
public:
    // The shape must be checked (scree::checked). `plane_reach`: half the width of a plane, m, about its point nearest to
    // `middle`; planes stand in the world, other shapes in the body's frame.
    Drawn add(const Shape& shape, float plane_reach, glm::vec3 middle);
    const std::vector<Triangles>& meshes() const { return meshes_; }

private:
    Drawn shared(const std::string& key, glm::vec3 scale, Triangles&& made);
    std::map<std::string, std::size_t> known_;
    std::vector<Triangles> meshes_;
};

}  // namespace scree::demos
