// Triangle meshes of cylinders, cones, hulls and meshes, for the canvas.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compute/scene.h"
#include "host/canvas/canvas.h"

namespace scree::demos {

host::SolidMesh cylinder_mesh();              // radius 1, half height 1
host::SolidMesh cone_mesh();                  // radius 1, height 1, about the centre of mass
host::SolidMesh hull_mesh(const Hull& hull);  // the hull must be validated
// Triangles [first, last) of a mesh, in the frame of the first one's row. Images of their surfaces go into `textures`.
host::SolidMesh patch_mesh(const MeshForm& form, std::size_t first, std::size_t last, std::vector<host::CanvasTexture>& textures);
// The same of all skins of a body one after the other, in the frame of one of its parts.
host::SolidMesh patch_mesh(const std::vector<Skin>& skins, std::size_t first, std::size_t last, const Part& part,
                           std::vector<host::CanvasTexture>& textures);

// How a triangle of a form looks; corners in the form's order.
struct TriangleLook {
    const host::SurfaceMaterial* material = nullptr;  // null: as its body
    std::array<glm::vec2, 3> at{};
    std::array<std::uint32_t, 3> colors{};
};
TriangleLook look_of(const MeshForm& form, std::size_t triangle);

}  // namespace scree::demos
