// A scene from a file, with the meshes that it names.
#pragma once

#include <cstddef>
#include <filesystem>

#include "compute/scene_file/scene_json.h"

namespace scree {

// Reads a scene file, and the mesh files that it names, which lie beside it. Throws SceneError as scene_from_json does, for a
// mesh that cannot be read too, and std::runtime_error naming the file when the scene's own cannot be read.
SceneDocument load_scene(const std::filesystem::path& path, std::size_t most_bodies = static_cast<std::size_t>(-1));

}  // namespace scree
