// Writing a scene as JSON, one body per line, with the shortest digits that read back to the same float.
#include <string_view>

#include "compute/fields/document.h"
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
        text << "{" << (view.orthographic ? "\"orthographic\": true, " : "") << "\"path\": [";
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

}  // namespace

std::string body_to_json(const Body& body) {
    return text_of_fields(body);
}
std::string joint_to_json(const Joint& joint) {
    return text_of_fields(joint);
}

std::string scene_to_json(const Scene& scene, const std::optional<Viewpoint>& viewpoint) {
    Text text;
    text << "{\"gravity\": " << scene.gravity << ",\n";
    if (viewpoint) write_camera(text, *viewpoint);
    write_list(text, "bodies", scene.bodies);
    if (!scene.joints.empty()) write_list(text << ",\n", "joints", scene.joints);
    if (!scene.vehicles.empty()) write_list(text << ",\n", "vehicles", scene.vehicles);
    if (!scene.exclusions.empty()) write_list(text << ",\n", "exclusions", scene.exclusions);
    text << "}\n";
    return text.take();
}

}  // namespace scree
