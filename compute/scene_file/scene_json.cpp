// Reading a scene from JSON text: body by body as the parser meets them, so that a large file never becomes a large tree.
#include "compute/scene_file/scene_json.h"

#include <algorithm>
#include <vector>

#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/shapes_json.h"
#include "compute/scene_file/vehicles_json.h"

namespace scree {

namespace {

using namespace json_reading;
using Event = json::parse_event_t;

const Names scene_keys = {"gravity", "bodies", "joints", "vehicles", "camera"};
const Names body_keys = {
    "name",    "motion",   "shape",       "position",           "orientation",    "velocity",        "angular_velocity",
    "density", "friction", "restitution", "rolling_resistance", "linear_damping", "angular_damping", "gravity_scale",
    "tyre",    "fracture"};

}  // namespace

namespace json_reading {

static void read(const json& value, const Place& place, Motion& out) {
    std::string word;
    read(value, place, word);
    const Names known = {"dynamic", "fixed", "kinematic"};
    const auto found = std::find(known.begin(), known.end(), word);
    if (found == known.end()) refuse(place, unknown("motion", word, known));
    out = static_cast<Motion>(found - known.begin());
}

static void read(const json& value, const Place& place, Cutting& out) {
    std::string word;
    read(value, place, word);
    const Names known = {"voronoi", "boxes", "splinters"};
    const auto found = std::find(known.begin(), known.end(), word);
    if (found == known.end()) refuse(place, unknown("cutting", word, known));
    out = static_cast<Cutting>(found - known.begin());
}

static void read(const json& value, const Place& place, std::optional<Fracture>& out) {
    only(value, place, {"impulse", "momentum", "cutting", "pieces", "depth", "seed"});
    Fracture& fracture = out.emplace();
    std::size_t seed = fracture.seed;
    for (const char* threshold : {"impulse", "momentum"}) {
        float& limit = threshold[0] == 'i' ? fracture.impulse : fracture.momentum;
        optional(value, place, threshold, limit);
        if (value.contains(threshold) && !(limit > 0)) refuse(place / threshold, "must be positive, N s");
    }
    optional(value, place, "cutting", fracture.cutting);
    optional(value, place, "pieces", fracture.pieces);
    optional(value, place, "depth", fracture.depth);
    optional(value, place, "seed", seed);
    if (seed > 0xFFFFFFFFu) refuse(place / "seed", "must be below 4294967296");
    fracture.seed = static_cast<std::uint32_t>(seed);
}

static void read(const json& value, const Place& place, std::optional<Tyre>& out) {
    only(value, place, {"best_slip", "sliding"});
    Tyre& tyre = out.emplace();
    optional(value, place, "best_slip", tyre.best_slip);
    optional(value, place, "sliding", tyre.sliding);
}

Body body_of(const json& value, const Place& place) {
    only(value, place, body_keys);
    Body body;
    optional(value, place, "name", body.name);
    optional(value, place, "motion", body.motion);
    required(value, place, "shape", body.shape);
    optional(value, place, "position", body.position);
    optional(value, place, "orientation", body.orientation);
    optional(value, place, "velocity", body.velocity);
    optional(value, place, "angular_velocity", body.angular_velocity);
    optional(value, place, "density", body.density);
    optional(value, place, "friction", body.friction);
    optional(value, place, "restitution", body.restitution);
    optional(value, place, "rolling_resistance", body.rolling_resistance);
    optional(value, place, "linear_damping", body.linear_damping);
    optional(value, place, "angular_damping", body.angular_damping);
    optional(value, place, "gravity_scale", body.gravity_scale);
    optional(value, place, "tyre", body.tyre);
    optional(value, place, "fracture", body.fracture);
    return body;
}

// What a view that stands still and a moment of one that moves have alike.
template <class View>
static void read_view(const json& value, const Place& place, View& view) {
    required(value, place, "eye", view.eye);
    required(value, place, "target", view.target);
    optional(value, place, "vertical_fov", view.vertical_fov);
    if (!(view.vertical_fov >= 1 && view.vertical_fov <= 170))
        refuse(place / "vertical_fov", "must be between 1 and 170 degrees");
    if (view.eye == view.target) refuse(place / "target", "must differ from the eye");
}

static void read(const json& value, const Place& place, std::vector<ViewKey>& path) {
    if (!value.is_array() || value.empty()) refuse(place, "must be an array of at least one moment, is " + kind(value));
    for (std::size_t i = 0; i < value.size(); ++i) {
        const Place here = place / i;
        only(value[i], here, {"time", "eye", "target", "vertical_fov"});
        ViewKey& key = path.emplace_back();
        required(value[i], here, "time", key.time);
        read_view(value[i], here, key);
        if (!(key.time >= 0 && key.time <= 1e6f)) refuse(here / "time", "must be between 0 and 1000000 s");
        if (i > 0 && !(key.time > path[i - 1].time)) refuse(here / "time", "must be later than that of the moment before");
    }
}

}  // namespace json_reading

namespace {

Viewpoint viewpoint_of(const json& value, const Place& place) {
    only(value, place, {"eye", "target", "vertical_fov", "orthographic", "path"});
    Viewpoint view;
    optional(value, place, "orthographic", view.orthographic);
    optional(value, place, "path", view.path);
    if (view.path.empty()) {
        read_view(value, place, view);
        return view;
    }
    for (const char* key : {"eye", "target", "vertical_fov"}) {
        if (value.contains(key)) refuse(place / key, "the path has its own, for each moment; leave it or the path out");
    }
    view.eye = view.path[0].eye;
    view.target = view.path[0].target;
    view.vertical_fov = view.path[0].vertical_fov;
    return view;
}

// Listens to the parser: takes each element of /bodies as soon as it is whole, and lets go of its tree.
class Listener {
public:
    Listener(Scene& scene, std::size_t most_bodies) : scene_(scene), most_bodies_(most_bodies) {}

    bool operator()(int depth, Event event, const json& parsed) {
        if (event == Event::object_start) keys_.emplace_back();
        if (event == Event::key) note_key(parsed.get_ref<const std::string&>());
        if (event == Event::object_end) keys_.pop_back();
        const bool ends = event == Event::object_end || event == Event::array_end || event == Event::value;
        if (!ends || depth != 2 || top_key_ != "bodies") return true;
        if (scene_.bodies.size() == most_bodies_) {
            refuse(bodies_, "more than " + std::to_string(most_bodies_) +
                                " bodies, which is what fits into the memory here; use fewer bodies or a larger machine");
        }
        scene_.bodies.push_back(body_of(parsed, bodies_ / scene_.bodies.size()));
        return false;
    }

private:
    void note_key(const std::string& key) {
        if (keys_.size() == 1) top_key_ = key;
        Names& seen = keys_.back();
        if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
            const Place body = bodies_ / scene_.bodies.size();
            const bool inside = keys_.size() > 1 && top_key_ == "bodies";
            throw SceneError(inside ? body.pointer() : "/" + escaped(top_key_), "the key \"" + key + "\" appears twice");
        }
        seen.push_back(key);
    }

    Scene& scene_;
    std::size_t most_bodies_;
    std::vector<Names> keys_;  // of the objects that are open
    std::string top_key_;
    const Place root_{nullptr, nullptr, 0};
    const Place bodies_ = root_ / "bodies";
};

}  // namespace

SceneDocument scene_from_json(std::string_view text, std::size_t most_bodies) {
    SceneDocument document;
    json rest;
    try {
        rest = json::parse(text, Listener(document.scene, most_bodies));
    } catch (const json::parse_error& error) {
        refuse_syntax(text, error);
    } catch (const json::out_of_range& error) {
        refuse_number(text, error);
    }
    const Place root{nullptr, nullptr, 0};
    only(rest, root, scene_keys);
    if (!rest.contains("bodies")) refuse(root, "a scene needs \"bodies\", an array");
    if (!rest["bodies"].is_array()) refuse(root / "bodies", "must be an array, is " + kind(rest["bodies"]));
    optional(rest, root, "gravity", document.scene.gravity);
    if (rest.contains("camera")) document.viewpoint = viewpoint_of(rest["camera"], root / "camera");
    if (rest.contains("joints")) read_joints(rest["joints"], document.scene);
    if (rest.contains("vehicles")) read_vehicles(rest["vehicles"], document.scene);
    return document;
}

}  // namespace scree
