// Materials and collision filters of glTF physics.
#pragma once

#include <vector>

#include "compute/scene.h"
#include "compute/scene_file/import/gltf/gltf_reader.h"

namespace scree::imports {

std::vector<Material> gltf_materials(const GltfValue& materials);
// Which classes of collision meet: each filter is one, behind the first, which is what has no filter.
std::vector<std::vector<bool>> gltf_filters(const GltfValue& filters);

}  // namespace scree::imports
