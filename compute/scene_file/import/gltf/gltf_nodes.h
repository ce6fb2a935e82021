// Nodes of a glTF scene and their transforms.
#pragma once

#include "compute/scene_file/import/gltf/gltf_reader.h"
#include "compute/scene_file/import/model.h"

namespace scree::imports {

struct GltfNode {
    glm::dmat4 world{1};
    glm::dmat4 of_shapes{1};        // the same for implicit shapes, whose size is by the absolute values of the node's own scale
    std::size_t body = world_body;  // of the model; the body that moves it
    bool reached = false;           // from the scene's root
};

glm::dmat4 local_matrix(GltfValue& node);
// With absolute values of the node's own scale.
glm::dmat4 of_shapes(GltfValue& node, glm::dmat4 world);
glm::dmat4 matrix_of(const Placed& placed);
dvec3 scale_of(const glm::dmat4& matrix);
// Whether the axes stay at right angles, to a ten thousandth.
bool keeps_right_angles(const glm::dmat4& matrix);
// Position and axes of a transform: its y axis, then its x axis; the z axis so that they are right-handed.
Placed placed_of(const glm::dmat4& matrix);

}  // namespace scree::imports
