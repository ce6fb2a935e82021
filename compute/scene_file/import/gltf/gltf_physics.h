// glTF with KHR_physics_rigid_bodies and KHR_implicit_shapes (drafts) as scenes.
#pragma once

#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/scene_json.h"

namespace scree::imports {

// `name`: of the file in its folder.
SceneDocument scene_of_gltf(const std::string& name, Folder& folder, const ImportOptions& options, Notes& notes,
                            std::size_t most_bodies);

}  // namespace scree::imports
