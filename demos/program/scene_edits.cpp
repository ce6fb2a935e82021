// Changes of single values of a scene.
#include "demos/program/scene_edits.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <nlohmann/json.hpp>

#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"

namespace scree::demos {

namespace {

using nlohmann::json;
constexpr std::size_t most_parts = 32;  // of a key

std::vector<std::string> parts_of(const std::string& key) {
    std::vector<std::string> parts;
    for (std::size_t from = key.starts_with('/') ? 1 : 0; from <= key.size();) {
        const std::size_t to = std::min(key.find('/', from), key.size());
        parts.push_back(key.substr(from, to - from));
        from = to + 1;
    }
    return parts;
}

[[noreturn]] void refuse_edit(const SceneEdit& edit, const std::string& reason) {
    throw UsageError(fmt::format("--set {}={}: {}", edit.key, edit.value, reason));
}

json& element_of(json& list, const std::string& part, const SceneEdit& edit) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (error == std::errc() && end == part.data() + part.size()) {
        if (index >= list.size())
            refuse_edit(edit, fmt::format("there is no element {}; there are {}, counted from 0", part, list.size()));
        return list[index];
    }
    std::vector<std::string> names;
    for (json& one : list) {
        if (!one.is_object() || !one.contains("name") || !one["name"].is_string()) continue;
        if (one["name"] == part) return one;
        if (names.size() < 1000) names.push_back(one["name"]);
    }
    const std::string near = nearest(part, names);
    refuse_edit(edit, fmt::format("no element is named \"{}\"{}", part, near.empty() ? "" : "; nearest: \"" + near + "\""));
}

void set_value(json& value, const std::vector<std::string>& parts, std::size_t next, const SceneEdit& edit) {
    if (next == parts.size()) {
        value = json::parse(edit.value, nullptr, false);
        if (value.is_discarded()) value = edit.value;
        return;
    }
    const std::string& part = parts[next];
    if (part.empty()) refuse_edit(edit, "the key has an empty part");
    if (value.is_null()) value = json::object();
    if (value.is_object()) return set_value(value[part], parts, next + 1, edit);
    if (!value.is_array()) refuse_edit(edit, fmt::format("\"{}\" lies in a value that has no members", part));
    if (part != "*") return set_value(element_of(value, part, edit), parts, next + 1, edit);
    for (json& one : value) set_value(one, parts, next + 1, edit);
}

}  // namespace

SceneEdit scene_edit_of(const std::string& word) {
    const std::size_t equals = word.find('=');
    if (equals == word.npos || equals == 0)
        throw CLI::ValidationError("--set", fmt::format("is KEY=VALUE, such as bodies/3/friction=0.2, is \"{}\"", word));
    return {word.substr(0, equals), word.substr(equals + 1)};
}

std::string edited(const std::string& scene, const std::vector<SceneEdit>& edits) {
    if (edits.empty()) return scene;
    json document = json::parse(scene, nullptr, false);
    if (!document.is_object()) return scene;  // which its reader refuses with the place
    for (const SceneEdit& edit : edits) {
        const std::vector<std::string> parts = parts_of(edit.key);
        if (parts.size() > most_parts) refuse_edit(edit, "the key has more than 32 parts");
        set_value(document, parts, 0, edit);
    }
    return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace scree::demos
