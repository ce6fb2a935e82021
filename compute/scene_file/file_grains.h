// Grains of scene files between reading and adding them: their meshes may be files.
#pragma once

#include <cstddef>
#include <string_view>

#include "compute/scene_file/scene_json.h"

namespace scree {

// As scene_from_json(), with the grains still to be added.
SceneDocument scene_before_grains(std::string_view text, std::size_t most_bodies);

}  // namespace scree
