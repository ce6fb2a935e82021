// Triangle mesh files: Wavefront OBJ, glTF and GLB.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "host/files/file.h"

namespace scree::host {

struct MeshFile {
    std::vector<glm::vec3> vertices;    // in the file's units, node transforms applied
    std::vector<glm::uvec3> triangles;  // vertex indices, counter-clockwise seen from outside
};

// Reads all triangles of a file with the extension .obj, .gltf or .glb; polygons are triangulated, materials and
// textures ignored. Throws FileError, naming the file and the place in it, if it is malformed, has no triangles, or
// needs a compression extension.
MeshFile read_mesh(const std::filesystem::path& path);
// The same from memory; `name` gives the extension and appears in messages. A .gltf finds its buffers in `folder`.
MeshFile mesh_of(std::string_view bytes, const std::string& name, const std::filesystem::path& folder = {});

}  // namespace scree::host
