// Files of other programs as scenes, by their endings.
#include "compute/scene_file/import/import_scene.h"

#include <algorithm>

#include "compute/scene_file/import/gltf/gltf_physics.h"
#include "compute/scene_file/import/mesh_scene.h"
#include "compute/scene_file/import/mjcf/mjcf.h"
#include "compute/scene_file/import/urdf/urdf.h"
#include "compute/scene_file/import/usd/usd_scene.h"

namespace scree {

namespace {

std::string ending_of_import(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

SceneDocument document_of_xml(imports::Folder& folder, const std::string& name, const ImportOptions& options,
                              imports::Notes& notes, std::size_t most_bodies) {
    host::XmlElement root;
    const imports::Origin file{folder.shown(), 0, ""};
    try {
        root = host::xml_of(folder.bytes(file, name), folder.shown());
    } catch (const host::FileError& error) {
        throw ImportError(error.what());
    }
    if (root.name == "mujoco") return imports::scene_of_mjcf(std::move(root), folder, options, notes, most_bodies);
    if (root.name == "robot") return imports::scene_of_urdf(root, folder, options, notes, most_bodies);
    imports::refuse({folder.shown(), root.line, ""},
                    "begins with <" + root.name.substr(0, 60) + ">; MJCF begins with <mujoco>, URDF with <robot>");
}

}  // namespace

bool is_imported(const std::filesystem::path& path) {
    const std::string ending = ending_of_import(path);
    for (const char* known : {".xml", ".mjcf", ".urdf", ".stl", ".obj", ".gltf", ".glb", ".usda", ".usdc", ".usdz", ".usd"})
        if (ending == known) return true;
    return false;
}

SceneDocument import_scene(const std::filesystem::path& path, const ImportOptions& options, std::vector<std::string>& notes,
                           std::size_t most_bodies) {
    imports::Folder folder(path, options);
    imports::Notes collected;
    const std::string ending = ending_of_import(path), name = path.filename().string();
    const bool mesh = ending == ".stl" || ending == ".obj", gltf = ending == ".gltf" || ending == ".glb",
               usd = ending.starts_with(".usd");
    SceneDocument document = mesh   ? imports::scene_of_mesh(name, folder, options, collected)
                             : gltf ? imports::scene_of_gltf(name, folder, options, collected, most_bodies)
                             : usd  ? imports::scene_of_usd(name, folder, options, collected, most_bodies)
                                    : document_of_xml(folder, name, options, collected, most_bodies);
    const std::vector<std::string> told = collected.told(options.strict);
    notes.insert(notes.end(), told.begin(), told.end());
    return document;
}

}  // namespace scree
