// Bodies, joints, vehicles and settings as bytes, by their field tables (compute/schema).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "compute/schema/body.h"
#include "compute/schema/check.h"
#include "compute/schema/joint.h"
#include "compute/schema/scene.h"
#include "compute/schema/vehicle.h"
#include "compute/world/states/byte_stream.h"

namespace scree {

template <class Type>
inline constexpr bool is_variant = false;
template <class... Types>
inline constexpr bool is_variant<std::variant<Types...>> = true;
template <class Type>
concept OfAShape = requires {
    ShapeInfo<Type>::fields;
};

// Calls visit(value) for each member that a struct's table has.
template <class Struct, class Visit>
void for_each_member(Struct& one, const Visit& visit) {
    using Kind = std::remove_const_t<Struct>;
    if constexpr (OfAShape<Kind>) {
        for_each_shape_field<Kind>([&](const auto& field) { visit(one.*field.member); });
        if constexpr (std::is_same_v<Kind, Mesh>) visit(one.file), visit(one.scale), visit(one.decompose);
        if constexpr (std::is_same_v<Kind, Compound>) visit(one.skins);
    } else if constexpr (std::is_same_v<Kind, Part>) {
        visit(one.shape), visit(one.position), visit(one.orientation), visit(one.density), visit(one.filter);
        visit(one.role), visit(one.material), visit(one.skinned);
    } else {
        schema::for_each_field<Kind>([&](const auto& field) { visit(one.*field.member); });
    }
}

template <class Value>
void put_value(ByteWriter& out, const Value& value) {
    if constexpr (std::is_same_v<Value, std::string>) {
        out.put_text(value);
    } else if constexpr (schema::is_optional<Value>) {
        out.put(static_cast<std::uint8_t>(value.has_value()));
        if (value) put_value(out, *value);
    } else if constexpr (schema::is_list<Value>) {
        out.put(std::uint64_t{value.size()});
        for (const auto& one : value) put_value(out, one);
    } else if constexpr (is_variant<Value>) {
        out.put(static_cast<std::uint8_t>(value.index()));
        std::visit([&](const auto& one) { put_value(out, one); }, value);
    } else if constexpr (std::is_same_v<Value, Skin>) {
        put_value(out, *value.mesh);
        put_value(out, value.position);
        put_value(out, value.orientation);
    } else if constexpr (OfAShape<Value> || std::is_same_v<Value, Part> || schema::HasTable<Value>) {
        for_each_member(value, [&](const auto& member) { put_value(out, member); });
    } else {
        out.put(value);
    }
}

template <class Variant, std::size_t index = 0>
void choose_alternative(Variant& value, std::size_t chosen) {
    if constexpr (index == std::variant_size_v<Variant>) {
        throw CheckpointError("the checkpoint is damaged: a kind that is not known");
    } else {
        if (chosen == index)
            value.template emplace<index>();
        else
            choose_alternative<Variant, index + 1>(value, chosen);
    }
}

template <class Value>
void take_value(ByteReader& in, Value& value) {
    if constexpr (std::is_same_v<Value, std::string>) {
        value = in.take_text();
    } else if constexpr (schema::is_optional<Value>) {
        value.reset();
        if (in.take<std::uint8_t>() != 0) take_value(in, value.emplace());
    } else if constexpr (schema::is_list<Value>) {
        value.clear();
        for (auto left = in.take<std::uint64_t>(); left > 0; --left) take_value(in, value.emplace_back());
    } else if constexpr (is_variant<Value>) {
        choose_alternative(value, in.take<std::uint8_t>());
        std::visit([&](auto& one) { take_value(in, one); }, value);
    } else if constexpr (std::is_same_v<Value, Skin>) {
        auto mesh = std::make_shared<Mesh>();
        take_value(in, *mesh);
        value.mesh = std::move(mesh);
        take_value(in, value.position);
        take_value(in, value.orientation);
    } else if constexpr (OfAShape<Value> || std::is_same_v<Value, Part> || schema::HasTable<Value>) {
        for_each_member(value, [&](auto& member) { take_value(in, member); });
    } else if constexpr (schema::HasWords<Value>) {
        const auto number = in.take<std::underlying_type_t<Value>>();
        if (number < 0 || static_cast<std::size_t>(number) >= schema::words<Value>.size())
            throw CheckpointError("the checkpoint is damaged: a word that is not known");
        value = static_cast<Value>(number);
    } else {
        value = in.take<Value>();
    }
}

}  // namespace scree
