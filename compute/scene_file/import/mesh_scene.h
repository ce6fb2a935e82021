// STL and OBJ files as scenes.
#pragma once

#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/scene_json.h"

namespace scree::imports {

// One body of the density of bodies; `name`: of the file in its folder.
SceneDocument scene_of_mesh(const std::string& name, Folder& folder, const ImportOptions& options, Notes& notes);

}  // namespace scree::imports
