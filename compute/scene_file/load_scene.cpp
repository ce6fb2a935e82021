// Loading a scene file with its meshes.
#include "compute/scene_file/load_scene.h"

#include "host/files/mesh_file.h"

namespace scree {

namespace {

void read_meshes(Scene& scene, const std::filesystem::path& folder) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        auto* mesh = std::get_if<Mesh>(&scene.bodies[i].shape);
        if (!mesh || mesh->file.empty()) continue;
        try {
            host::MeshFile read = host::read_mesh(folder / mesh->file);
            mesh->vertices = std::move(read.vertices);
            mesh->triangles = std::move(read.triangles);
            for (vec3& vertex : mesh->vertices) vertex *= mesh->scale;
        } catch (const host::FileError& error) {
            throw SceneError("/bodies/" + std::to_string(i) + "/shape/mesh/file", error.what());
        }
    }
}

}  // namespace

SceneDocument load_scene(const std::filesystem::path& path, std::size_t most_bodies) {
    SceneDocument document = scene_from_json(host::read_text(path), most_bodies);
    read_meshes(document.scene, path.parent_path());
    return document;
}

}  // namespace scree
