// Reading hand-written JSON: every error with its JSON pointer, unknown words with the nearest known one.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "compute/scene.h"

namespace scree::json_reading {

using nlohmann::json;
using Names = std::vector<std::string>;

// A value's place in the document; converted to a JSON pointer only for errors.
struct Place {
    const Place* parent;
    const char* key;
    std::size_t index;

    std::string pointer() const {
        if (!parent && !key) return "";
        return (parent ? parent->pointer() : "") + "/" + (key ? std::string(key) : std::to_string(index));
    }
    Place operator/(const char* child) const { return {this, child, 0}; }
    Place operator/(std::size_t child) const { return {this, nullptr, child}; }
};

// All of these throw SceneError with the value's JSON pointer.
[[noreturn]] void refuse(const Place& place, const std::string& reason);
void only(const json& object, const Place& place, const Names& known);  // requires an object without other keys
// The value of a key; null where one that may be missing is.
const json* value_of(const json& object, const Place& place, const char* key, bool required, bool is_list);
void read(const json& value, const Place& place, bool& out);
void read(const json& value, const Place& place, float& out);  // finite
void read(const json& value, const Place& place, std::string& out);
void read(const json& value, const Place& place, std::uint64_t& out);
void read(const json& value, const Place& place, std::uint32_t& out);
void read(const json& value, const Place& place, std::int32_t& out);
// std::size_t where it is neither of these types.
template <std::same_as<std::size_t> Size>
requires(!std::is_same_v<Size, std::uint64_t> && !std::is_same_v<Size, std::uint32_t>) void read(const json& value,
                                                                                                 const Place& place, Size& out) {
    std::uint64_t number = 0;
    read(value, place, number);
    if (number > std::numeric_limits<Size>::max()) refuse(place, "must be below 4294967296");
    out = static_cast<Size>(number);
}
// Red, green, blue in sRGB, as numbers or "#rrggbb" or "#rgb".
void read_color(const json& value, const Place& place, glm::vec3& out);
// Index of a known word; `what` names the kind of word in messages.
std::size_t index_among(const Names& known, const std::string& word, const char* what, const Place& place);
Body body_of(const json& value, const Place& place);  // as in a scene file

template <glm::length_t size>
void read(const json& value, const Place& place, glm::vec<size, float>& out);

template <class Value>
void optional(const json& object, const Place& place, const char* key, Value& out) {
    if (const auto found = object.find(key); found != object.end()) read(*found, place / key, out);
}

template <class Value>
void required(const json& object, const Place& place, const char* key, Value& out) {
    if (!object.contains(key)) refuse(place, std::string("lacks \"") + key + "\"");
    read(object[key], place / key, out);
}

// For messages.
std::string kind(const json& value);  // "an array of 3"
std::string listed(const Names& names);
// For pointers in messages: escaped, and cut after 200 letters.
std::string shortened_name(const std::string& name);
std::string unknown(const char* what, const std::string& name, const Names& known);
std::string escaped(std::string key);  // of a JSON pointer, RFC 6901

[[noreturn]] void refuse_syntax(std::string_view text, const json::parse_error& error);
[[noreturn]] void refuse_number(std::string_view text, const json::out_of_range& error);
// Reports a syntax error with line and column. `callback`: for json::parse().
template <class... Callback>
json parsed(std::string_view text, Callback&&... callback) {
    try {
        return json::parse(text, std::forward<Callback>(callback)...);
    } catch (const json::parse_error& error) {
        refuse_syntax(text, error);
    } catch (const json::out_of_range& error) {
        refuse_number(text, error);
    }
}

template <glm::length_t size>
void read(const json& value, const Place& place, glm::vec<size, float>& out) {
    if (!value.is_array() || value.size() != size) {
        refuse(place, "must be an array of " + std::to_string(size) + " numbers, is " + kind(value));
    }
    for (glm::length_t i = 0; i < size; ++i)
        read(value[static_cast<std::size_t>(i)], place / static_cast<std::size_t>(i), out[i]);
}

}  // namespace scree::json_reading
