// Transforms of glTF's nodes.
#include "compute/scene_file/import/gltf/gltf_nodes.h"

#include <cmath>

namespace scree::imports {

glm::dmat4 local_matrix(GltfValue& node) {
    glm::dmat4 matrix(1);
    const auto all = node.numbers("matrix", 16), at = node.numbers("translation", 3), turn = node.numbers("rotation", 4),
               scale = node.numbers("scale", 3);
    for (std::size_t i = 0; i < all.size(); ++i) matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = all[i];
    if (!at.empty()) matrix[3] = glm::dvec4(at[0], at[1], at[2], 1);
    if (!turn.empty()) {
        const dquat q(turn[3], turn[0], turn[1], turn[2]);
        if (!(glm::length(q) > 1e-9)) node.refuse("\"rotation\" is a quaternion of length 0");
        matrix *= glm::mat4_cast(glm::normalize(q));
    }
    for (int k = 0; k < 3 && !scale.empty(); ++k) matrix[k] *= scale[static_cast<std::size_t>(k)];
    return matrix;
}

glm::dmat4 of_shapes(GltfValue& node, glm::dmat4 world) {
    const auto scale = node.numbers("scale", 3);
    for (int k = 0; k < 3 && !scale.empty(); ++k)
        if (scale[static_cast<std::size_t>(k)] < 0) world[k] = -world[k];
    return world;
}

glm::dmat4 matrix_of(const Placed& placed) {
    glm::dmat4 matrix = glm::mat4_cast(placed.turn);
    matrix[3] = glm::dvec4(placed.position, 1);
    return matrix;
}

dvec3 scale_of(const glm::dmat4& matrix) {
    return {glm::length(dvec3(matrix[0])), glm::length(dvec3(matrix[1])), glm::length(dvec3(matrix[2]))};
}

bool keeps_right_angles(const glm::dmat4& matrix) {
    const dvec3 scale = scale_of(matrix);
    const auto square = [&](int i, int k) {
        return std::abs(glm::dot(dvec3(matrix[i]), dvec3(matrix[k]))) <= 1e-4 * scale[i] * scale[k];
    };
    return square(0, 1) && square(1, 2) && square(2, 0);
}

Placed placed_of(const glm::dmat4& matrix) {
    const auto unit = [](const dvec3& v, const dvec3& otherwise) {
        return glm::length(v) > 1e-12 ? glm::normalize(v) : otherwise;
    };
    const dvec3 y = unit(dvec3(matrix[1]), {0, 1, 0}), along = unit(dvec3(matrix[0]), {1, 0, 0});
    const dvec3 aside = std::abs(y.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
    const dvec3 x = unit(along - y * glm::dot(y, along), glm::normalize(aside - y * glm::dot(y, aside)));
    return {dvec3(matrix[3]), glm::normalize(glm::quat_cast(dmat3(x, y, glm::cross(x, y))))};
}

}  // namespace scree::imports
