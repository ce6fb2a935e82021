// Files of other programs as scenes: MJCF (.xml, .mjcf), URDF (.urdf, .xml), STL, OBJ, glTF physics (.gltf, .glb),
// and UsdPhysics (.usda, .usdc, .usdz).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/scene_file/import/import_options.h"
#include "compute/scene_file/scene_json.h"

namespace scree {

// A file that cannot become a scene. what() is "FILE:LINE: reason", of glTF "FILE: JSON pointer: reason".
struct ImportError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

bool is_imported(const std::filesystem::path& path);  // by its extension

// The scene of a file. It may name files in its own folder and in those of its packages alone. Appends to `notes` what is not
// translated, with file, line and reason, each kind once. Throws ImportError, with `strict` also for a note.
SceneDocument import_scene(const std::filesystem::path& path, const ImportOptions& options, std::vector<std::string>& notes,
                           std::size_t most_bodies = static_cast<std::size_t>(-1));

}  // namespace scree
