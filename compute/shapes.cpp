// Lookups in the list of shapes.
#include "compute/shapes.h"

namespace scree {

const char* shape_name(const Shape& shape) {
    return std::visit([](const auto& one) { return ShapeInfo<std::remove_cvref_t<decltype(one)>>::name; }, shape);
}

std::optional<SimpleShape> simple_shape(const Shape& shape) {
    return std::visit(
        [](const auto& one) -> std::optional<SimpleShape> {
            if constexpr (std::is_constructible_v<SimpleShape, decltype(one)>) return SimpleShape(one);
            return std::nullopt;
        },
        shape);
}

Shape whole_shape(const SimpleShape& shape) {
    return std::visit([](const auto& one) { return Shape(one); }, shape);
}

}  // namespace scree
