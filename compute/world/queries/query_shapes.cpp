// Shapes of queries: checked, and taken apart into convex pieces.
#include "compute/world/queries/query_shapes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "compute/compile/scene_compiler.h"
#include "compute/scene/double_quaternion.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/shape_geometry.h"
#include "compute/world/queries/query_check.h"

namespace scree {

namespace {

template <class Value>
bool holds(const Value& value, const FieldRange& range) {
    const auto within = [&](float v) { return v >= range.least && v <= range.most; };
    if constexpr (std::is_same_v<Value, float>) return within(value);
    if constexpr (std::is_same_v<Value, vec3>) return within(value.x) && within(value.y) && within(value.z);
    if constexpr (std::is_same_v<Value, std::vector<vec3>>)
        return std::all_of(value.begin(), value.end(), [&](vec3 v) { return holds(v, range); });
    return true;
}

vec4 checked_turn(const char* kind, std::size_t index, const std::string& what, vec4 q) {
    const double squared = glm::dot(glm::dvec4(q), glm::dvec4(q));
    if (!std::isfinite(squared) || squared < 1e-12)
        refuse_query(kind, index, what + " orientation must be finite and not of length 0");
    return std::abs(squared - 1) <= 2.5e-7 ? q : vec4(glm::dvec4(q) / std::sqrt(squared));
}

// A pose in a frame at another.
physics::Pose within(const physics::Pose& frame, glm::dvec3 position, const glm::dquat& orientation) {
    const glm::dquat turn = double_quaternion(frame.orientation);
    return {vec3(glm::dvec3(frame.position) + turn * position), 0, single_quaternion(glm::normalize(turn * orientation))};
}

}  // namespace

void QueryShapes::add(const char* kind, const Shape& shape, vec3 position, vec4 orientation) {
    const std::size_t index = starts_.size() - 1;
    if (!is_finite(position)) refuse_query(kind, index, "its position must be finite");
    const vec4 turn = checked_turn(kind, index, "its", orientation);
    const std::optional<SimpleShape> simple = simple_shape(shape);
    const auto* compound = std::get_if<Compound>(&shape);
    if ((!simple && !compound) || std::holds_alternative<Plane>(shape))
        refuse_query(kind, index, "its shape must be convex or a compound, not a " + std::string(shape_name(shape)));
    if (simple) add_piece(kind, *simple, position, turn);
    for (std::size_t k = 0; compound && k < compound->parts.size(); ++k) {
        const Part& part = compound->parts[k];
        if (part.role != Role::solid) continue;
        const std::string what = "its part " + std::to_string(k) + "'s";
        if (std::holds_alternative<Plane>(part.shape)) refuse_query(kind, index, what + " shape must be convex, not a plane");
        if (!holds(part.position, within_shape_range)) refuse_query(kind, index, what + " position is out of range");
        const vec4 part_turn = checked_turn(kind, index, what, part.orientation);
        const physics::Pose pose = within({position, 0, turn}, part.position, double_quaternion(part_turn));
        add_piece(kind, part.shape, pose.position, pose.orientation);
    }
    if (pieces_.size() == starts_.back()) refuse_query(kind, index, "its compound has no solid part");
    starts_.push_back(pieces_.size());
}

void QueryShapes::add_piece(const char* kind, const SimpleShape& shape, vec3 position, vec4 orientation) {
    const std::size_t index = starts_.size() - 1;
    std::visit(
        [&](const auto& one) {
            for_each_shape_field<decltype(one)>([&](const auto& field) {
                if (!holds(one.*field.member, field.range))
                    refuse_query(kind, index, std::string(field.name) + " is out of range");
            });
        },
        shape);
    Piece& piece = pieces_.emplace_back();
    piece.form.shape = static_cast<physics::uint>(shape.index());
    piece.pose = {position, 0, orientation};
    const auto* hull = std::get_if<Hull>(&shape);
    if (!hull) {
        piece.form.size = record_size(shape);
        return;
    }
    // A step has hulls about their centre of mass, along their principal axes.
    try {
        const CheckedShapes::MadeHull& made = shapes_.hull_of(hull->points);
        piece.form.size = record_size(made.hull);
        piece.pose = within(piece.pose, made.centre, made.axes);
        const auto [place, fresh] = places_.try_emplace(made.hull.form.get(), static_cast<physics::uint>(own_hulls_.size()));
        if (fresh) {
            const std::vector<physics::uvec4> records = hull_records(made.hull);
            own_hulls_.insert(own_hulls_.end(), records.begin(), records.end());
        }
        piece.form.shape_data = place->second;
    } catch (const HullError& error) {
        refuse_query(kind, index, std::string("its hull: ") + error.what());
    }
}

void QueryShapes::join(const State& state) {
    table_ = state.hull_table().records;
    if (own_hulls_.empty()) return;
    const auto before = static_cast<physics::uint>(state.hulls.size());
    for (Piece& piece : pieces_)
        if (piece.form.shape == physics::SHAPE_HULL) piece.form.shape_data += before;
    joined_.assign(state.hulls.begin(), state.hulls.end());
    joined_.insert(joined_.end(), own_hulls_.begin(), own_hulls_.end());
    table_ = joined_.data();
}

}  // namespace scree
