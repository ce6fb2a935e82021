// Implicit shapes of glTF under the transforms of their nodes: exact where scree has the shape, else hulls of it.
#pragma once

#include <vector>

#include <functional>
#include <string>

#include "compute/scene_file/import/gltf/gltf_nodes.h"

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
// A shape in its own frame, along y.
struct ImplicitShape {
    enum class Kind { sphere, box, capsule, cylinder, plane } kind = Kind::box;
    dvec3 size{1};                               // of a box, m
    double height = 1, bottom = 0.5, top = 0.5;  // of the others; of a sphere `bottom` is its radius, m
};
using ShapeNote = std::function<void(const char* kind, const std::string& reason)>;
GltfShape stretched_shape(const ImplicitShape& shape, const glm::dmat4& frame, const ShapeNote& note);

GltfShape gltf_shape(GltfValue shape, const glm::dmat4& frame);

}  // namespace scree::imports
