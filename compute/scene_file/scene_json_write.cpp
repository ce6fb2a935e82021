// Writing a scene as JSON, one body per line, with the shortest digits that read back to the same float.
#include <xxhash.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <string_view>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_write.h"
#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/json_text.h"
#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/shapes_json.h"

namespace scree {

namespace {

template <class Value>
std::string text_of_fields(const Value& value) {
    Text text;
    write_value(text, value);
    return text.take();
}

// One element per line.
template <class Things>
void write_list(Text& text, const char* key, const Things& things) {
    const char* between = "\n  ";
    text << " \"" << key << "\": [";
    for (const auto& one : things) {
        if constexpr (requires { one.piece_of; }) {
            if (one.piece_of != no_body) continue;  // fragments are made when the scene is checked
        }
        text << between;
        write_value(text, one);
        between = ",\n  ";
    }
    text << "\n]";
}

void write_camera(Text& text, const Viewpoint& view) {
    text << " \"camera\": ";
    if (view.path.empty()) {
        write_value(text, view);
    } else {
        text << "{" << (view.orthographic ? "\"orthographic\": true, " : "");
        if (view.orbit != 0) text << "\"orbit\": " << view.orbit << ", ";
        text << "\"path\": [";
        const char* between = "\n  ";
        for (const ViewKey& moment : view.path) {
            text << between;
            write_value(text, moment);
            between = ",\n  ";
        }
        text << "]}";
    }
    text << ",\n";
}

// `shown`: all of a document but its scene and viewpoint.
std::string to_json(const Scene& scene, const std::optional<Viewpoint>& viewpoint, const SceneDocument& shown) {
    Text text;
    text << "{\"gravity\": " << scene.gravity << ",\n";
    const auto write_one = [&](const char* key, const auto& value, const auto& by_default) {
        if (is_default(value, by_default)) return;
        text << " \"" << key << "\": ";
        write_value(text, value);
        text << ",\n";
    };
    write_one("fields", scene.fields, Fields{});
    write_one("periodic", scene.periodic, PeriodicCell{});
    write_one("settings", shown.settings, std::optional<Settings>());
    write_one("duration", shown.duration, 0.0f);
    if (viewpoint) write_camera(text, *viewpoint);
    write_one("picture", shown.picture, std::optional<PictureStyle>());
    write_one("measures", shown.measures, std::optional<MeasureRequest>());
    write_list(text, "bodies", scene.bodies);
    if (!scene.joints.empty()) write_list(text << ",\n", "joints", scene.joints);
    if (!scene.vehicles.empty()) write_list(text << ",\n", "vehicles", scene.vehicles);
    if (!scene.exclusions.empty()) write_list(text << ",\n", "exclusions", scene.exclusions);
    if (!scene.bonds.empty()) write_list(text << ",\n", "bond_pairs", scene.bonds);
    if (!shown.events.empty()) write_list(text << ",\n", "events", shown.events);
    text << "}\n";
    return text.take();
}

// `others`: the bodies behind those of the scene; may be empty.
std::uint64_t hash_with(const Scene& scene, const std::function<void(const TakeBody&)>& others) {
    const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> hash(XXH64_createState(), XXH64_freeState);
    if (!hash) throw std::bad_alloc();
    XXH64_reset(hash.get(), 0);
    const auto add = [&](const std::string& text) { XXH64_update(hash.get(), text.data(), text.size()); };
    add(text_of_fields(scene.gravity));
    const auto add_body = [&](const Body& body) {
        if (body.piece_of == no_body) add(text_of_fields(body));
    };
    std::ranges::for_each(scene.bodies, add_body);
    if (others) others(add_body);
    for (const Joint& joint : scene.joints) add(text_of_fields(joint));
    for (const Vehicle& vehicle : scene.vehicles) add(text_of_fields(vehicle));
    for (const Bond& bond : scene.bonds) add(text_of_fields(bond));
    if (!is_default(scene.fields, Fields{})) add(text_of_fields(scene.fields));
    if (!is_default(scene.periodic, PeriodicCell{})) add(text_of_fields(scene.periodic));
    return XXH64_digest(hash.get());
}

}  // namespace

std::uint64_t hash_of(const Scene& scene) {
    return hash_with(scene, {});
}
std::uint64_t hash_of(const StreamedScene& scene) {
    return hash_with(scene.scene, scene.others);
}

std::string body_to_json(const Body& body) {
    return text_of_fields(body);
}
std::string joint_to_json(const Joint& joint) {
    return text_of_fields(joint);
}

std::string scene_to_json(const Scene& scene, const std::optional<Viewpoint>& viewpoint) {
    return to_json(scene, viewpoint, {});
}
std::string scene_to_json(const SceneDocument& document) {
    return to_json(document.scene, document.viewpoint, document);
}

}  // namespace scree
