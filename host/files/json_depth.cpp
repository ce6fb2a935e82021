// Nesting depth check of JSON text, in one pass without recursion.
#include "host/files/json_depth.h"

#include <algorithm>
#include <vector>

namespace scree::host {

namespace {

constexpr std::size_t most_shown = 8;  // tokens of a JSON pointer in messages

// An array or object that encloses the current position.
struct Open {
    bool is_array;
    std::size_t index = 0;      // of the current array element
    std::string_view key = {};  // of the current object member
};

std::string pointer_to(const std::vector<Open>& open) {
    std::string pointer;
    for (std::size_t i = 0; i < std::min(open.size(), most_shown); ++i) {
        pointer += '/';
        if (open[i].is_array) pointer += std::to_string(open[i].index);
        for (const char c : open[i].key) pointer += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return open.size() > most_shown ? pointer + "/..." : pointer;
}

// Index of the closing quote of the string that begins at `at`.
std::size_t end_of_string(std::string_view json, std::size_t at) {
    for (++at; at < json.size() && json[at] != '"'; ++at)
        if (json[at] == '\\') ++at;
    return std::min(at, json.size());
}

}  // namespace

std::optional<std::string> nested_deeper_than(std::size_t most, std::string_view json) {
    std::vector<Open> open;
    bool expects_key = false;
    for (std::size_t at = 0; at < json.size(); ++at) {
        const char c = json[at];
        if (c == '"') {
            const std::size_t end = end_of_string(json, at);
            if (expects_key && !open.empty()) open.back().key = json.substr(at + 1, end - at - 1);
            expects_key = false;
            at = end;
        } else if (c == '{' || c == '[') {
            if (open.size() == most) return pointer_to(open);
            open.push_back({.is_array = c == '['});
            expects_key = c == '{';
        } else if ((c == '}' || c == ']') && !open.empty()) {
            open.pop_back();
            expects_key = false;
        } else if (c == ',' && !open.empty()) {
            expects_key = !open.back().is_array;
            if (open.back().is_array) ++open.back().index;
        }
    }
    return std::nullopt;
}

}  // namespace scree::host
