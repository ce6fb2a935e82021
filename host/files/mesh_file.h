// Triangle mesh files: Wavefront OBJ, glTF and GLB, STL.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/files/file.h"
#include "host/files/mesh_surface.h"

namespace scree::host {

struct MeshFile {
    std::vector<glm::vec3> vertices;               // in the file's units, node transforms applied
    std::vector<glm::uvec3> triangles;             // vertex indices, counter-clockwise seen from outside
    std::vector<std::size_t> groups{};             // first triangle of each group or object of an OBJ file
    std::vector<std::string> materials{};          // "usemtl" of each group's first triangle; "": none
    std::vector<std::string> libraries{};          // "mtllib" of an OBJ file
    std::optional<glm::vec3> color{};              // base colour of the first material, linear; of meshes_of_gltf() alone
    std::shared_ptr<const MeshSurface> surface{};  // how it looks; null: nothing is said
    std::vector<std::string> remarks{};            // what of that is left out, and why
};

// Reads all triangles of a file with the extension .obj, .gltf, .glb or .stl; polygons are triangulated. Images
// are files of its folder or below; those that cannot be read are left out with a remark. Throws FileError, naming the file and
// the place in it, if it is malformed, has no triangles, or needs a compression extension.
MeshFile read_mesh(const std::filesystem::path& path);
// The same from memory; `name` gives the extension and appears in messages. A .gltf finds its buffers and images in `folder`, an
// .obj its materials; without it no files are read.
MeshFile mesh_of(std::string_view bytes, const std::string& name, const std::filesystem::path& folder = {});
// The meshes of a .gltf or .glb one by one, without their nodes; those without triangles are empty. Throws FileError.
std::vector<MeshFile> meshes_of_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder = {});
// The JSON of a .gltf, or of the first chunk of a .glb. Throws FileError if it is nested too deeply for parsers.
std::string_view json_of_gltf(std::string_view bytes, const std::string& name);
// The triangles, groups and names of materials of an OBJ file, with its surface if `folder` is given. Throws FileError with the
// line.
MeshFile mesh_of_obj(std::string_view bytes, const std::string& name, const std::filesystem::path& folder = {});
// The diffuse colours ("Kd", sRGB, 0 to 1) of an OBJ file's material library, by "newmtl". Throws FileError with the line.
std::map<std::string, glm::vec3> colors_of_mtl(std::string_view bytes, const std::string& name);
struct MtlMaterial {
    std::optional<glm::vec3> color{};  // "Kd", as above
    std::string image{};               // "map_Kd"; empty: none
    glm::vec2 scale{1}, offset{0};     // of texture coordinates
    bool clamps = false;
};
std::map<std::string, MtlMaterial> materials_of_mtl(std::string_view bytes, const std::string& name);
// The triangles of an STL file, binary or text, with three vertices each. Throws FileError.
MeshFile mesh_of_stl(std::string_view bytes, const std::string& name);

}  // namespace scree::host
