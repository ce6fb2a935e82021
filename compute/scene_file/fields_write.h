// Writing a struct as JSON by its field table; members with their default are omitted.
#pragma once

#include <bit>
#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>

#include "compute/scene_file/json_text.h"
#include "compute/scene_file/shapes_json.h"
#include "compute/schema/check.h"
#include "compute/schema/field.h"

namespace scree {

// Whether a member has its default, bit for bit: -0 is not 0.
template <class Value>
bool is_default(const Value& value, const Value& by_default) {
    if constexpr (std::is_same_v<Value, float>) {
        return std::bit_cast<unsigned>(value) == std::bit_cast<unsigned>(by_default);
    } else if constexpr (requires { Value::length(); }) {
        for (glm::length_t i = 0; i < Value::length(); ++i)
            if (!is_default(value[i], by_default[i])) return false;
        return true;
    } else if constexpr (schema::is_optional<Value>) {
        return !value;
    } else if constexpr (schema::is_list<Value>) {
        return value.empty();
    } else if constexpr (schema::HasTable<Value>) {
        bool all = true;
        schema::for_each_field<Value>(
            [&](const auto& field) { all = all && is_default(value.*field.member, by_default.*field.member); });
        return all;
    } else if constexpr (requires { value.valueless_by_exception(); }) {
        return false;  // the kind of a joint and the shape of a body are always written
    } else {
        return value == by_default;
    }
}

template <class Value>
void write_value(Text& text, const Value& value);

// `between`: the separator before the next member.
template <schema::HasTable Struct>
void write_fields(Text& text, const Struct& from, const char*& between) {
    [[maybe_unused]] static const Struct by_default;
    schema::for_each_field<Struct>([&]<class Member>(const schema::Field<Struct, Member>& field) {
        const Member& member = from.*field.member;
        if constexpr (schema::HasTable<Member>) {
            if (field.embedded()) return write_fields(text, member, between);
        }
        if (field.presence == schema::Presence::optional && is_default(member, by_default.*field.member)) return;
        text.key(between, field.key);
        write_value(text, member);
        between = ", ";
    });
}

template <class Value>
void write_value(Text& text, const Value& value) {
    if constexpr (schema::is_optional<Value>) {
        write_value(text, *value);
    } else if constexpr (schema::is_list<Value>) {
        const char* between = "[";
        for (const auto& one : value) {
            text << between;
            write_value(text, one);
            between = ", ";
        }
        text << (value.empty() ? "[]" : "]");
    } else if constexpr (schema::HasAlternatives<Value>) {
        text << "{\"" << schema::alternatives<Value>.keys[value.index()] << "\": ";
        std::visit([&](const auto& one) { write_value(text, one); }, value);
        text << "}";
    } else if constexpr (schema::HasTable<Value>) {
        const char* between = "{";
        write_fields(text, value, between);
        text << (*between == '{' ? "{}" : "}");
    } else if constexpr (schema::HasWords<Value>) {
        text << "\"" << schema::words<Value>[static_cast<std::size_t>(value)] << "\"";
    } else if constexpr (std::is_same_v<Value, bool>) {
        text << (value ? "true" : "false");
    } else if constexpr (std::is_integral_v<Value>) {
        text << std::to_string(value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        text.quoted(value);
    } else if constexpr (std::is_same_v<Value, Shape>) {
        write_shape(text, value);
    } else {
        text << value;
    }
}

}  // namespace scree
