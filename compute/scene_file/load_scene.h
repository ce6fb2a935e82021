// Loading a scene file with the meshes that it names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compute/scene_file/import/import_options.h"
#include "compute/scene_file/scene_json.h"

namespace scree {

// Whether load_scene() translates a file of another program (compute/scene_file/import), by its ending.
bool is_scene_import(const std::filesystem::path& path);

// Reads a scene file and the mesh files that it names, relative to it and in its folder or below. Throws SceneError like
// scene_from_json, also for a mesh that cannot be read or lies elsewhere, and std::runtime_error naming the file if the scene
// file cannot be read.
SceneDocument load_scene(const std::filesystem::path& path, std::size_t most_bodies = static_cast<std::size_t>(-1));
// The same from a scene file's text; meshes are found relative to `folder`, with `allow_outside` anywhere.
SceneDocument scene_from_text(std::string_view text, const std::filesystem::path& folder,
                              std::size_t most_bodies = static_cast<std::size_t>(-1), bool allow_outside = false,
                              std::vector<std::string>* notes = nullptr);
// The same, and files of other programs: MJCF (.xml, .mjcf), URDF (.urdf, .xml), STL, OBJ, glTF physics. Appends to `notes`, if
// given, what of those is not translated, as "FILE:LINE: reason", and remarks on grains (add_grains). Throws ImportError (a
// std::runtime_error) for them.
SceneDocument load_scene(const std::filesystem::path& path, const ImportOptions& options,
                         std::vector<std::string>* notes = nullptr, std::size_t most_bodies = static_cast<std::size_t>(-1));

// A scene file whose bodies stay there, for StreamedScene (compute/scene_stream.h).
struct StreamedDocument {
    SceneDocument document;                            // without bodies
    std::function<void(const TakeBody& take)> bodies;  // reads them from the file each time, and checks them
    std::size_t count = 0;                             // of bodies
};
// None where load_scene() is to read the file whole: files of other programs, those that refer to their bodies, syntax errors.
// Throws SceneError, in this first reading or a later one, like load_scene(); `notes`: as of scree::checked.
std::optional<StreamedDocument> stream_scene(const std::filesystem::path& path, const ImportOptions& options = {},
                                             std::vector<std::string>* notes = nullptr);

}  // namespace scree
