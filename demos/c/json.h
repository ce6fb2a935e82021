// Descriptions in JSON, as calls of the C interface take and give them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_read.h"
#include "compute/scene_file/fields_write.h"
#include "demos/c/call.h"
#include "host/files/json_depth.h"

namespace scree::c {

// The place of a whole text, in errors.
inline const json_reading::Place root{nullptr, nullptr, 0};

inline nlohmann::json json_given(const char* text, const char* name) {
    const std::string given = text_of(text, name);
    constexpr std::size_t most_depth = 64;  // copies of values are recursive
    if (const auto place = host::nested_deeper_than(most_depth, given))
        throw Failure(SCREE_BAD_SCENE, *place + ": is nested in more than 64 arrays and objects", *place);
    return json_reading::parsed(given);
}

template <class Value>
Value value_from(const nlohmann::json& given, const char* name) {
    Value made{};
    json_reading::read_value(given, root / name, made, "", {});
    return made;
}

// Also the members that have their default.
template <class Struct>
std::string whole_json(const Struct& from) {
    Text text;
    const char* between = "{";
    schema::for_each_field<Struct>([&](const auto& field) {
        text.key(between, field.key);
        write_value(text, from.*field.member);
        between = ", ";
    });
    text << "}";
    return text.take();
}

}  // namespace scree::c
