// USD scenes with UsdPhysics (.usda, .usdc, .usdz): prims with a rigid body become bodies, colliders below them their shapes.
// https://openusd.org/release/api/usd_physics_page_front.html
#pragma once

#include "compute/scene_file/import/folder.h"
#include "compute/scene_file/import/import_scene.h"

namespace scree::imports {

SceneDocument scene_of_usd(const std::string& name, Folder& folder, const ImportOptions& options, Notes& notes,
                           std::size_t most_bodies);

}  // namespace scree::imports
