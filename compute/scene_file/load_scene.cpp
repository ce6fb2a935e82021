// Loading a scene file with its meshes.
#include "compute/scene_file/load_scene.h"

#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "compute/scene/validation/body_validation.h"
#include "compute/scene_file/file_grains.h"
#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/import/import_scene.h"
#include "host/files/file.h"
#include "host/files/mesh_file.h"

namespace scree {

namespace {

// Reads the mesh files that bodies name, each once.
class MeshFiles {
public:
    MeshFiles(std::filesystem::path folder, bool allow_outside)
        : folder_(std::move(folder)),
          home_(imports::canonical_or_itself(folder_.empty() ? "." : folder_)),
          allow_outside_(allow_outside) {}
    // A body with a colour of its own has that instead of the file's.
    void read(Body& body, std::size_t index) {
        auto* mesh = std::get_if<Mesh>(&body.shape);
        if (!mesh || mesh->file.empty()) return;
        const std::string pointer = "/bodies/" + std::to_string(index) + "/shape/mesh/file";
        const host::MeshFile& found = file(mesh->file, pointer);
        if (!body.color) {
            mesh->surface = found.surface;
            if (told_.insert(mesh->file).second)
                for (const std::string& remark : found.remarks) remarks_.push_back(pointer + ": " + remark);
        }
        mesh->vertices = found.vertices;
        mesh->triangles = found.triangles;
        for (vec3& vertex : mesh->vertices) vertex *= mesh->scale;
    }
    // What of their base colours and images is left out.
    const std::vector<std::string>& remarks() const { return remarks_; }
    void read(Grains& grains, const std::string& place) {
        for (std::size_t i = 0; i < grains.shapes.size(); ++i) {
            auto* mesh = std::get_if<MeshGrain>(&grains.shapes[i].form);
            if (!mesh || mesh->file.empty()) continue;
            const std::string pointer = place + "/shapes/" + std::to_string(i) + "/form/mesh/file";
            if (!mesh->points.empty()) throw SceneError(pointer, "there are points already; leave one out");
            mesh->points = file(mesh->file, pointer).vertices;
            mesh->file.clear();
        }
    }

private:
    const host::MeshFile& file(const std::string& name, const std::string& pointer) {
        if (!allow_outside_ && !host::is_inside(imports::canonical_or_itself(home_ / name), home_))
            throw SceneError(pointer, "\"" + name + "\" lies outside of the scene file's folder, " + home_.string() +
                                          "; move it there, or allow it (--allow-outside, in Python allow_outside=True)");
        try {
            const auto [found, fresh] = files_.try_emplace(name);
            if (fresh) found->second = host::read_mesh(folder_ / name);
            return found->second;
        } catch (const host::FileError& error) {
            files_.erase(name);
            throw SceneError(pointer, error.what());
        }
    }

    std::filesystem::path folder_, home_;
    bool allow_outside_;
    std::map<std::string, host::MeshFile> files_;  // that several bodies may name
    std::set<std::string> told_;
    std::vector<std::string> remarks_;
};

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
    std::vector<std::string> told;
    SceneDocument document =
        scene_from_text(host::read_text(path), path.parent_path(), most_bodies, options.allow_outside, &told);
    if (notes)
        for (const std::string& note : told) notes->push_back(path.string() + ": " + note);
    return document;
}

SceneDocument scene_from_text(std::string_view text, const std::filesystem::path& folder, std::size_t most_bodies,
                              bool allow_outside, std::vector<std::string>* notes) {
    SceneDocument document = scene_before_grains(text, most_bodies);
    MeshFiles meshes(folder, allow_outside);
    for (std::size_t i = 0; i < document.grains.size(); ++i)
        meshes.read(document.grains[i].grains, "/grains/" + std::to_string(i));
    for (std::size_t i = 0; i < document.events.size(); ++i)
        if (auto* pour = std::get_if<PourEvent>(&document.events[i].action))
            meshes.read(pour->grains, "/events/" + std::to_string(i) + "/action/pour");
    add_grains(document, notes, most_bodies);
    for (std::size_t i = 0; i < document.scene.bodies.size(); ++i) meshes.read(document.scene.bodies[i], i);
    add_bonds(document);
    if (notes) notes->insert(notes->end(), meshes.remarks().begin(), meshes.remarks().end());
    return document;
}

std::optional<StreamedDocument> stream_scene(const std::filesystem::path& path, const ImportOptions& options,
                                             std::vector<std::string>* notes) {
    if (is_imported(path)) return std::nullopt;
    const auto read = [path, allow_outside = options.allow_outside](const TakeBody& take) {
        std::ifstream file(path);
        MeshFiles meshes(path.parent_path(), allow_outside);
        std::size_t index = 0;
        return scene_without_bodies(file, [&](Body body) {
            meshes.read(body, index++);
            take(std::move(body));
        });
    };
    BodyValidation validation(notes);
    std::size_t count = 0;
    std::optional<SceneDocument> document = read([&](Body body) { validation.check_passing(body, count++); });
    if (!document) return std::nullopt;
    const auto bodies = [read, path](const TakeBody& take) {
        BodyValidation of_this_reading;
        std::size_t index = 0;
        const bool whole = read([&](Body body) {
                               of_this_reading.check_passing(body, index++);
                               take(std::move(body));
                           }).has_value();
        if (!whole) throw std::runtime_error(path.string() + ": the file has changed since it was read");
    };
    return StreamedDocument{std::move(*document), bodies, count};
}

}  // namespace scree
