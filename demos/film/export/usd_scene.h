// A scene as a .usda with UsdPhysics: rigid bodies, colliders, masses, materials, joints, filters. Units are m and kg, y is up.
#pragma once

#include <string>
#include <vector>

#include "compute/scene.h"

namespace scree::demos {

// Each body is a prim below /World whose name ends with its index. What USD cannot say is appended to `notes`, each kind once.
// Throws SceneError.
std::string scene_to_usda(const Scene& scene, std::vector<std::string>& notes);

}  // namespace scree::demos
