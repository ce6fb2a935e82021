// Triangles from files: Wavefront OBJ, glTF and GLB.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "host/files/file.h"

namespace scree::host {

struct MeshFile {
    std::vector<glm::vec3> vertices;    // as the file has them, every object where its scene puts it
    std::vector<glm::uvec3> triangles;  // their corners, counter-clockwise seen from outside
};

// All triangles of a file whose name ends in .obj, .gltf or .glb; polygons are cut into triangles, materials and pictures are
// passed over. Throws FileError, naming the file and the place in it, for what cannot be read, has no triangles, or needs
// an extension that packs them.
MeshFile read_mesh(const std::filesystem::path& path);
// The same of bytes that came from elsewhere; `name` for its ending and for messages. A .gltf looks for its buffers in `folder`.
MeshFile mesh_of(std::string_view bytes, const std::string& name, const std::filesystem::path& folder = {});

}  // namespace scree::host
