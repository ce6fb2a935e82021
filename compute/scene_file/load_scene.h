// Loading a scene file with the meshes that it names.
#pragma once

#include <cstddef>
#include <filesystem>

#include "compute/scene_file/scene_json.h"

namespace scree {

// Reads a scene file and the mesh files that it names, relative to it. Throws SceneError like scene_from_json, also for
// a mesh that cannot be read, and std::runtime_error naming the file if the scene file cannot be read.
SceneDocument load_scene(const std::filesystem::path& path, std::size_t most_bodies = static_cast<std::size_t>(-1));

}  // namespace scree
