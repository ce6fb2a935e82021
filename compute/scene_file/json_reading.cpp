// Reading hand-written JSON: places, kinds and messages.
#include "compute/scene_file/json_reading.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "compute/scene_file/hex_color.h"

namespace scree::json_reading {

namespace {

// Levenshtein distance: number of letters to change, insert or delete.
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = std::exchange(row[j], std::min({changed, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row.back();
}

constexpr std::size_t longest_name = 200;  // that a message repeats; comparing takes the product of two lengths

std::string line_and_column(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, std::min(at, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t last = before.rfind('\n');
    return "line " + std::to_string(line) + ", column " +
           std::to_string(before.size() - (last == before.npos ? 0 : last + 1) + 1);
}

}  // namespace

std::string listed(const Names& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

std::string shortened_name(const std::string& name) {
    return name.size() > longest_name ? escaped(name.substr(0, longest_name)) + "..." : escaped(name);
}

std::string unknown(const char* what, const std::string& name, const Names& known) {
    if (name.size() > longest_name)
        return std::string("unknown ") + what + " of " + std::to_string(name.size()) + " letters; known: " + listed(known);
    const auto nearest = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return distance(name, a) < distance(name, b);
    });
    const bool near = distance(name, *nearest) <= 1 + name.size() / 3;
    return std::string("unknown ") + what + " \"" + name + "\"" + (near ? "; nearest: \"" + *nearest + "\"" : "") +
           "; known: " + listed(known);
}

std::string escaped(std::string key) {  // RFC 6901
    for (std::size_t at = 0; (at = key.find_first_of("~/", at)) != std::string::npos; at += 2)
        key.replace(at, 1, key[at] == '~' ? "~0" : "~1");
    return key;
}

void refuse(const Place& place, const std::string& reason) {
    throw SceneError(place.pointer(), reason);
}

std::string kind(const json& value) {
    if (value.is_number()) return "the number " + value.dump();
    if (value.is_string()) return "the string " + value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (value.is_boolean()) return value.dump();
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    return value.is_object() ? "an object" : "null";
}

void read(const json& value, const Place& place, float& out) {
    if (!value.is_number()) refuse(place, "must be a number, is " + kind(value));
    const double wide = value.get<double>();
    // Values up to half an ULP above the largest float still round to it.
    if (!(std::abs(wide) < 0x1.ffffffp127)) {
        refuse(place, "must be at most 3.4e38, what a 32-bit float holds; is " + value.dump());
    }
    out = static_cast<float>(wide);
}

void read(const json& value, const Place& place, std::string& out) {
    if (!value.is_string()) refuse(place, "must be a string, is " + kind(value));
    out = value.get<std::string>();
}

void read(const json& value, const Place& place, bool& out) {
    if (!value.is_boolean()) refuse(place, "must be true or false, is " + kind(value));
    out = value.get<bool>();
}

void read(const json& value, const Place& place, std::uint64_t& out) {
    if (!value.is_number_unsigned()) refuse(place, "must be a whole number of at least 0, is " + kind(value));
    out = value.get<std::uint64_t>();
}

void read(const json& value, const Place& place, std::uint32_t& out) {
    std::uint64_t number = 0;
    read(value, place, number);
    if (number > 0xFFFFFFFFu) refuse(place, "must be below 4294967296");
    out = static_cast<std::uint32_t>(number);
}

void read(const json& value, const Place& place, std::int32_t& out) {
    if (!value.is_number_integer()) refuse(place, "must be a whole number, is " + kind(value));
    const auto number = value.is_number_unsigned() && value.get<std::uint64_t>() > 0x7FFFFFFFu ? std::int64_t{1} << 40
                                                                                               : value.get<std::int64_t>();
    if (number > 0x7FFFFFFF || number < -0x7FFFFFFF) refuse(place, "must be within 2147483647 of 0, is " + kind(value));
    out = static_cast<std::int32_t>(number);
}

void read_color(const json& value, const Place& place, glm::vec3& out) {
    if (value.is_array() && value.size() == 3) return read(value, place, out);
    const auto known = value.is_string() ? color_of_hex(value.get_ref<const std::string&>()) : std::nullopt;
    if (!known)
        refuse(place,
               "must be an array of 3 numbers from 0 to 1 (red, green, blue in sRGB), or hexadecimal digits as in "
               "\"#ff8000\" or \"#f80\"; is " +
                   kind(value));
    out = *known;
}

std::size_t index_among(const Names& known, const std::string& word, const char* what, const Place& place) {
    const auto found = std::find(known.begin(), known.end(), word);
    if (found == known.end()) refuse(place, unknown(what, word, known));
    return static_cast<std::size_t>(found - known.begin());
}

void only(const json& object, const Place& place, const Names& known) {
    if (!object.is_object()) refuse(place, "must be an object, is " + kind(object));
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            throw SceneError(place.pointer() + "/" + shortened_name(key), unknown("key", key, known));
        }
    }
}

const json* value_of(const json& object, const Place& place, const char* key, bool required, bool is_list) {
    if (const auto found = object.find(key); found != object.end()) return &*found;
    if (required) refuse(place, is_list ? std::string("needs \"") + key + "\", an array" : std::string("lacks \"") + key + "\"");
    return nullptr;
}

void refuse_syntax(std::string_view text, const json::parse_error& error) {
    std::size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    std::size_t word = at;
    const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '-' || c == '+'; };
    while (word > 0 && letter(text[word - 1])) --word;
    for (const char* name : {"NaN", "nan", "-NaN", "Infinity", "-Infinity", "inf", "-inf", "Inf", "-Inf"}) {
        if (text.substr(word).starts_with(name)) {
            throw SceneError("", line_and_column(text, word) + ": " + name + " is no JSON number; every number must be finite");
        }
    }
    std::string what = error.what();  // "[json...] parse error at line 3, column 5: syntax error while ...: reason"
    if (const auto colon = what.find("syntax error"); colon != std::string::npos) what.erase(0, colon);
    throw SceneError("", line_and_column(text, at) + ": not valid JSON: " + what);
}

void refuse_number(std::string_view text, const json::out_of_range& error) {
    // "[...406] number overflow parsing '1e999'"
    const std::string what = error.what();
    const auto open = what.find('\''), close = what.rfind('\'');
    const std::string number = open < close ? what.substr(open + 1, close - open - 1) : "a number";
    const std::size_t at = text.find(number);
    const std::string where = at == text.npos ? "" : line_and_column(text, at) + ": ";
    throw SceneError("", where + number + " is out of range; numbers are 32-bit floats, at most 3.4e38");
}

}  // namespace scree::json_reading
