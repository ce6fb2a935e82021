// Loading a scene file with its meshes.
#include "compute/scene_file/load_scene.h"

#include <map>
#include <string>

#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/import/import_scene.h"
#include "host/files/mesh_file.h"

namespace scree {

namespace {

void read_meshes(Scene& scene, const std::filesystem::path& folder, bool allow_outside) {
    const std::filesystem::path home = imports::canonical_or_itself(folder.empty() ? "." : folder);
    std::map<std::string, host::MeshFile> files;  // that several bodies may name
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        auto* mesh = std::get_if<Mesh>(&scene.bodies[i].shape);
        if (!mesh || mesh->file.empty()) continue;
        const std::string pointer = "/bodies/" + std::to_string(i) + "/shape/mesh/file";
        if (!allow_outside && !imports::is_inside(imports::canonical_or_itself(home / mesh->file), home))
            throw SceneError(pointer, "\"" + mesh->file + "\" lies outside of the scene file's folder, " + home.string() +
                                          "; move it there, or allow it (--allow-outside)");
        try {
            const auto [found, fresh] = files.try_emplace(mesh->file);
            if (fresh) found->second = host::read_mesh(folder / mesh->file);
            mesh->vertices = found->second.vertices;
            mesh->triangles = found->second.triangles;
            for (vec3& vertex : mesh->vertices) vertex *= mesh->scale;
        } catch (const host::FileError& error) {
            throw SceneError(pointer, error.what());
        }
    }
}

}  // namespace

bool is_scene_import(const std::filesystem::path& path) {
    return is_imported(path);
}

SceneDocument load_scene(const std::filesystem::path& path, std::size_t most_bodies) {
    return load_scene(path, {}, nullptr, most_bodies);
}

SceneDocument load_scene(const std::filesystem::path& path, const ImportOptions& options, std::vector<std::string>* notes,
                         std::size_t most_bodies) {
    if (is_imported(path)) {
        std::vector<std::string> ignored;
        return import_scene(path, options, notes ? *notes : ignored, most_bodies);
    }
    return scene_from_text(host::read_text(path), path.parent_path(), most_bodies, options.allow_outside);
}

SceneDocument scene_from_text(std::string_view text, const std::filesystem::path& folder, std::size_t most_bodies,
                              bool allow_outside) {
    SceneDocument document = scene_from_json(text, most_bodies);
    read_meshes(document.scene, folder, allow_outside);
    return document;
}

}  // namespace scree
