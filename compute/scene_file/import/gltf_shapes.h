// Implicit shapes of glTF under the transforms of their nodes: exact where scree has the shape, else hulls of it.
#pragma once

#include <vector>

#include "compute/scene_file/import/gltf_nodes.h"

namespace scree::imports {

struct GltfShape {
    struct Part {
        SimpleShape shape;
        Placed placed;
    };
    std::vector<Part> parts;  // convex; together the shape
    SolidMass mass;           // of density 1; of a plane 0
};

// `frame`: of the shape in its body, with any scale and shear that is not flat. Notes what is not exact.
GltfShape gltf_shape(GltfValue shape, const glm::dmat4& frame);

}  // namespace scree::imports
