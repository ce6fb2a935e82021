// Joints of glTF physics.
#pragma once

#include "compute/scene_file/import/gltf/gltf_nodes.h"

namespace scree::imports {

// `joints`: by node; `kinds`: the document's physicsJoints; `fixed`: bodies of the scene before those of the model that move.
void add_gltf_joints(Scene& scene, const std::vector<std::pair<std::size_t, GltfValue>>& joints, const GltfValue& kinds,
                     const std::vector<GltfNode>& nodes, std::size_t fixed);

}  // namespace scree::imports
