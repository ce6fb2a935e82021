// Reading a scene from JSON, streaming: bodies are converted as the parser meets them, so a large file builds no large
// tree.
#include "compute/scene_file/scene_json.h"

#include <algorithm>
#include <istream>
#include <utility>
#include <vector>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_read.h"
#include "compute/scene_file/file_grains.h"
#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/shapes_json.h"

namespace scree {

namespace json_reading {

Body body_of(const json& value, const Place& place) {
    Body body;
    read_value(value, place, body, "", {});
    const auto fracture = value.find("fracture");
    if (fracture == value.end()) return body;
    for (const char* threshold : {"impulse", "momentum"})
        if (fracture->contains(threshold) && fracture->at(threshold) == 0)
            refuse(place / "fracture" / threshold, "must be positive, N s, is 0");
    return body;
}

}  // namespace json_reading

namespace {

using namespace json_reading;
using ParseEvent = json::parse_event_t;

template <class View>
void check_view(const Place& place, const View& view) {
    schema::check_fields(place, view);
    if (view.eye == view.target) refuse(place / "target", "must differ from the eye");
}

Viewpoint viewpoint_of(const json& value, const Place& place, const NamedThings& named, const Scene& scene) {
    Viewpoint view;
    read_value(value, place, view, "", named);
    if (view.follow != no_body) {
        if (view.follow >= scene.bodies.size())
            refuse(place / "follow", "there is no body " + std::to_string(view.follow) + "; the scene has " +
                                         std::to_string(scene.bodies.size()) + ", counted from 0");
        if (!view.path.empty()) refuse(place / "follow", "a camera with a path follows no body; remove it or the path");
    }
    if (view.chase && view.follow == no_body) refuse(place / "chase", "needs \"follow\", the body to chase");
    if (!value.contains("path")) {
        for (const char* key : {"eye", "target"})
            if (!value.contains(key)) refuse(place, std::string("lacks \"") + key + "\"");
        check_view(place, view);
        return view;
    }
    for (const char* key : {"eye", "target", "vertical_fov"}) {
        if (value.contains(key)) refuse(place / key, "each moment of the path has its own; remove it or the path");
    }
    const Place path = place / "path";
    if (view.path.empty()) refuse(path, "must be an array of at least one moment, is " + kind(value["path"]));
    for (std::size_t i = 0; i < view.path.size(); ++i) {
        check_view(path / i, view.path[i]);
        if (i > 0 && !(view.path[i].time > view.path[i - 1].time))
            refuse(path / i / "time", "must be later than that of the moment before");
    }
    view.eye = view.path[0].eye;
    view.target = view.path[0].target;
    view.vertical_fov = view.path[0].vertical_fov;
    return view;
}

// How the scene is run and shown.
void read_run(const json& rest, const Place& root, const NamedThings& named, SceneDocument& document) {
    const auto read_checked = [&](const auto& field) {
        read_field(rest, root, field, document, named);
        schema::check_field(root, document, field);
    };
    read_checked(schema::field_of(&SceneDocument::settings));
    read_checked(schema::field_of(&SceneDocument::duration));
    read_checked(schema::field_of(&SceneDocument::picture));
    read_checked(schema::field_of(&SceneDocument::events));
    read_field(rest, root, schema::field_of(&SceneDocument::grains), document, named);
    read_field(rest, root, schema::field_of(&SceneDocument::bonds), document, named);
    read_field(rest, root, schema::field_of(&SceneDocument::measures), document, named);
    if (document.picture) {
        const glm::vec2 range = document.picture->range;
        const Place picture = root / "picture", place = picture / "color_range";
        if (range.x > range.y) refuse(place, "must be [low, high], low first");
        if (document.picture->scale == ShownScale::logarithmic && range.x != range.y && range.x <= 0)
            refuse(place, "must begin above 0 on a logarithmic scale");
    }
}

// Each becomes a joint that has its name, so that events may refer to it.
void read_servo_walls(const json& rest, const Place& root, NamedThings& named, SceneDocument& document) {
    read_field(rest, root, schema::field_of(&SceneDocument::servo_walls), document, named);
    const std::vector<ServoWall> all = std::exchange(document.servo_walls, {});
    for (std::size_t i = 0; i < all.size(); ++i) add_servo_wall(document.scene, all[i], "/servo_walls/" + std::to_string(i));
    if (!all.empty()) named.joints = numbers_of(document.scene.joints);
}

// Parser callback: takes each element of /bodies as soon as it is complete, and frees its tree.
class Listener {
public:
    Listener(const TakeBody& take, std::size_t most_bodies) : take_(take), most_bodies_(most_bodies) {}

    bool operator()(int depth, ParseEvent event, const json& parsed) {
        if (event == ParseEvent::object_start) keys_.emplace_back();
        if (event == ParseEvent::key) note_key(parsed.get_ref<const std::string&>());
        if (event == ParseEvent::object_end) keys_.pop_back();
        const bool ends = event == ParseEvent::object_end || event == ParseEvent::array_end || event == ParseEvent::value;
        if (!ends || depth != 2 || top_key_ != "bodies") return true;
        if (count_ == most_bodies_) {
            refuse(bodies_, "more than " + std::to_string(most_bodies_) +
                                " bodies, which is what fits into the memory here; use fewer bodies or a larger machine");
        }
        take_(body_of(parsed, bodies_ / count_));
        ++count_;
        return false;
    }

private:
    void note_key(const std::string& key) {
        if (keys_.size() == 1) top_key_ = key;
        Names& seen = keys_.back();
        if (seen.size() >= most_keys)
            throw SceneError("/" + shortened_name(top_key_), "an object has more than " + std::to_string(most_keys) + " keys");
        if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
            const Place body = bodies_ / count_;
            const bool inside = keys_.size() > 1 && top_key_ == "bodies";
            throw SceneError(inside ? body.pointer() : "/" + escaped(top_key_), "the key \"" + key + "\" appears twice");
        }
        seen.push_back(key);
    }

    static constexpr std::size_t most_keys = 256;  // several times those of any object; each is compared with all before it

    const TakeBody& take_;
    std::size_t most_bodies_, count_ = 0;
    std::vector<Names> keys_;  // keys of the open objects
    std::string top_key_;
    const Place root_{nullptr, nullptr, 0};
    const Place bodies_ = root_ / "bodies";
};

// The document around its bodies, which are in it already unless they have gone elsewhere.
void read_around(const json& rest, SceneDocument& document) {
    const Place root{nullptr, nullptr, 0};
    only(rest, root, keys_of<SceneDocument>());
    if (!rest.contains("bodies")) refuse(root, "a scene needs \"bodies\", an array");
    if (!rest["bodies"].is_array()) refuse(root / "bodies", "must be an array, is " + kind(rest["bodies"]));
    Scene& scene = document.scene;
    read_field(rest, root, schema::field_of(&Scene::gravity), scene, {});
    NamedThings named{numbers_of(scene.bodies), {}};
    if (rest.contains("joints")) read_joints(rest["joints"], named, scene);
    read_servo_walls(rest, root, named, document);
    read_field(rest, root, schema::field_of(&Scene::vehicles), scene, named);
    read_field(rest, root, schema::field_of(&Scene::exclusions), scene, named);
    read_field(rest, root, schema::field_of(&Scene::bonds), scene, named);
    read_field(rest, root, schema::field_of(&Scene::fields), scene, {});
    read_field(rest, root, schema::field_of(&Scene::periodic), scene, {});
    if (rest.contains("camera")) document.viewpoint = viewpoint_of(rest["camera"], root / "camera", named, scene);
    read_run(rest, root, named, document);
}

bool refers_to_bodies(const json& rest) {
    const auto names_any = [&](const char* key) { return rest.contains(key) && !rest[key].empty(); };
    const bool follows = rest.contains("camera") && rest["camera"].is_object() && rest["camera"].contains("follow");
    return follows || names_any("joints") || names_any("vehicles") || names_any("exclusions") || names_any("events") ||
           names_any("grains") || names_any("bonds") || names_any("bond_pairs") || names_any("servo_walls") ||
           names_any("measures");
}

}  // namespace

SceneDocument scene_before_grains(std::string_view text, std::size_t most_bodies) {
    SceneDocument document;
    const TakeBody take = [&](Body body) { document.scene.bodies.push_back(std::move(body)); };
    read_around(parsed(text, Listener(take, most_bodies)), document);
    return document;
}

SceneDocument scene_from_json(std::string_view text, std::size_t most_bodies) {
    SceneDocument document = scene_before_grains(text, most_bodies);
    add_grains(document, nullptr, most_bodies);
    add_bonds(document);
    return document;
}

std::optional<SceneDocument> scene_without_bodies(std::istream& text, const TakeBody& take) {
    json rest;
    try {
        rest = json::parse(text, Listener(take, static_cast<std::size_t>(-1)));
    } catch (const json::exception&) {
        return std::nullopt;  // where, the text as a whole tells
    }
    if (!rest.is_object() || refers_to_bodies(rest)) return std::nullopt;
    SceneDocument document;
    read_around(rest, document);
    return document;
}

}  // namespace scree
