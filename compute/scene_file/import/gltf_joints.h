// Joints of glTF physics.
#pragma once

#include "compute/scene_file/import/gltf_reader.h"
#include "compute/scene_file/import/model.h"

namespace scree::imports {

struct GltfNode {
    glm::dmat4 world{1};
    std::size_t body = world_body;  // of the model, that carries it
    bool reached = false;           // by the scene
};

glm::dmat4 local_matrix(GltfValue& node);

// `joints`: by node; `kinds`: the document's physicsJoints; `fixed`: bodies of the scene before those of the model that move.
void add_gltf_joints(Scene& scene, const std::vector<std::pair<std::size_t, GltfValue>>& joints, const GltfValue& kinds,
                     const std::vector<GltfNode>& nodes, std::size_t fixed);

Placed placed_of(const glm::dmat4& matrix);  // without its scale

}  // namespace scree::imports
