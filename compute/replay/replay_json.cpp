// Recordings as JSON: one command per line, floats that read back bit-identically.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "compute/replay/replay.h"
#include "compute/scene/error_reason.h"
#include "compute/scene_file/joints_json.h"
#include "compute/scene_file/json_reading.h"
#include "compute/scene_file/scene_json.h"
#include "compute/schema/body.h"

namespace scree::replay {

namespace {

using namespace json_reading;

const Names keys = {"scree_input", "scene", "bodies",   "seed", "rate",      "substeps",
                    "sleeping",    "steps", "end_hash", "acts", "start_hash"};
const Names act_names = {"grab", "drag",  "release", "add",    "join",         "unjoin",   "push",      "explode",
                         "turn", "drive", "righten", "remove", "set_material", "set_mass", "set_motion"};
constexpr std::uint64_t most_steps = 1000000000;  // as --steps

// Keys and members of an act that has no others, and needs all of them.
template <class Act>
constexpr auto members = std::make_tuple();
template <>
constexpr auto members<Grab> = std::make_tuple(std::pair("grip", &Grab::grip), std::pair("body", &Grab::body),
                                               std::pair("anchor", &Grab::anchor), std::pair("target", &Grab::target));
template <>
constexpr auto members<Drag> = std::make_tuple(std::pair("grip", &Drag::grip), std::pair("target", &Drag::target));
template <>
constexpr auto members<Release> = std::make_tuple(std::pair("grip", &Release::grip));
template <>
constexpr auto members<Unjoin> = std::make_tuple(std::pair("joint", &Unjoin::joint));
template <>
constexpr auto members<Push> = std::make_tuple(std::pair("body", &Push::body), std::pair("force", &Push::force));
template <>
constexpr auto members<Explode> = std::make_tuple(std::pair("centre", &Explode::centre), std::pair("radius", &Explode::radius),
                                                  std::pair("speed", &Explode::speed));
template <>
constexpr auto members<Righten> = std::make_tuple(std::pair("vehicle", &Righten::vehicle));
template <>
constexpr auto members<Remove> = std::make_tuple(std::pair("body", &Remove::body));
template <>
constexpr auto members<SetMass> = std::make_tuple(std::pair("body", &SetMass::body), std::pair("mass", &SetMass::mass));

// ---- writing
std::string text_of(float value) {
    if (value == 0) return std::signbit(value) ? "-0.0" : "0";
    char digits[64];
    char* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    // Readers convert via double; if that rounds twice to a neighbour, write all digits.
    double wide = 0;
    std::from_chars(digits, end, wide);
    if (static_cast<float>(wide) != value) end = std::to_chars(digits, digits + sizeof digits, static_cast<double>(value)).ptr;
    return {digits, end};
}
std::string text_of(vec3 v) {
    return "[" + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + "]";
}
std::string text_of(bool value) {
    return value ? "true" : "false";
}
template <std::integral Number>
std::string text_of(Number value) {
    return std::to_string(value);
}
std::string hexadecimal(std::uint64_t hash) {
    return '"' + hash_text(hash) + '"';
}

// "name": {"key": value, ...}
template <typename... Pairs>
std::string act_text(const char* name, const Pairs&... pairs) {
    std::string inside;
    ((inside += std::string(inside.empty() ? "\"" : ", \"") + pairs.first + "\": " + text_of(pairs.second)), ...);
    return std::string("\"") + name + "\": {" + inside + "}";
}

// Calls visit(key, value) for each coefficient, under the body's key.
template <class Visit>
void for_each_coefficient(auto& act, const Visit& visit) {
    visit(schema::field_of(&Body::friction).key, act.friction);
    visit(schema::field_of(&Body::restitution).key, act.restitution);
    visit(schema::field_of(&Body::rolling_resistance).key, act.rolling_resistance);
}

template <class Act>
std::string plain_text(const char* name, const Act& act) {
    return std::apply([&](const auto&... one) { return act_text(name, std::pair(one.first, act.*one.second)...); }, members<Act>);
}

struct Writer {
    std::string operator()(const Grab& act) const { return plain_text("grab", act); }
    std::string operator()(const Drag& act) const { return plain_text("drag", act); }
    std::string operator()(const Release& act) const { return plain_text("release", act); }
    std::string operator()(const Add& act) const { return "\"add\": " + body_to_json(act.body); }
    std::string operator()(const Join& act) const { return "\"join\": " + joint_to_json(act.joint); }
    std::string operator()(const Unjoin& act) const { return plain_text("unjoin", act); }
    std::string operator()(const Push& act) const { return plain_text("push", act); }
    std::string operator()(const Explode& act) const { return plain_text("explode", act); }
    std::string operator()(const Drive& act) const {
        return act_text("drive", std::pair("vehicle", act.vehicle), std::pair("throttle", act.controls.throttle),
                        std::pair("brake", act.controls.brake), std::pair("steer", act.controls.steer),
                        std::pair("hand_brake", act.controls.hand_brake));
    }
    std::string operator()(const Righten& act) const { return plain_text("righten", act); }
    std::string operator()(const Remove& act) const { return plain_text("remove", act); }
    std::string operator()(const SetMass& act) const { return plain_text("set_mass", act); }
    std::string operator()(const SetMaterial& act) const {
        std::string inside = "\"body\": " + text_of(act.body);
        for_each_coefficient(act, [&](const char* key, const std::optional<float>& value) {
            if (value) inside += std::string(", \"") + key + "\": " + text_of(*value);
        });
        return "\"set_material\": {" + inside + "}";
    }
    std::string operator()(const SetMotion& act) const {
        return "\"set_motion\": {\"body\": " + text_of(act.body) + ", \"motion\": \"" +
               schema::words<Motion>[static_cast<std::size_t>(act.motion)] + "\"}";
    }
    std::string operator()(const Turn& act) const {
        std::string inside;
        const auto add = [&](const char* key, const auto& value) {
            if (value) inside += std::string(inside.empty() ? "\"" : ", \"") + key + "\": " + text_of(*value);
        };
        add("gravity", act.gravity);
        add("substeps", act.substeps);
        add("friction_factor", act.friction_factor);
        add("least_restitution", act.least_restitution);
        add("sleeping", act.sleeping);
        return "\"turn\": {" + inside + "}";
    }
};

// ---- reading
std::uint64_t hash_of(const json& value, const Place& place) {
    std::string word;
    read(value, place, word);
    std::uint64_t hash = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), hash, 16);
    if (word.size() != 16 || error != std::errc() || end != word.data() + word.size())
        refuse(place, "must be 16 hexadecimal digits, is \"" + word + "\"");
    return hash;
}

Turn turn_of(const json& value, const Place& place) {
    only(value, place, {"gravity", "substeps", "friction_factor", "least_restitution", "sleeping"});
    if (value.empty()) refuse(place, "changes no setting");
    Turn turn;
    if (value.contains("gravity")) read(value["gravity"], place / "gravity", turn.gravity.emplace());
    if (value.contains("friction_factor"))
        read(value["friction_factor"], place / "friction_factor", turn.friction_factor.emplace());
    if (value.contains("least_restitution"))
        read(value["least_restitution"], place / "least_restitution", turn.least_restitution.emplace());
    if (value.contains("sleeping")) read(value["sleeping"], place / "sleeping", turn.sleeping.emplace());
    if (value.contains("substeps")) {
        std::size_t substeps = 0;
        read(value["substeps"], place / "substeps", substeps);
        if (substeps < 1 || substeps > 64) refuse(place / "substeps", "must be between 1 and 64");
        turn.substeps = static_cast<int>(substeps);
    }
    return turn;
}

// A body, validated as a scene's, with errors at its place in this file.
Body added_body(const json& value, const Place& place) {
    const Body body = body_of(value, place);
    try {
        return checked(Scene{vec3(0), {body}}).bodies.front();
    } catch (const SceneError& error) {
        const std::string inside = std::string_view(error.pointer).starts_with("/bodies/0") ? error.pointer.substr(9) : "";
        throw SceneError(place.pointer() + inside, reason_of(error));
    }
}

SetMaterial material_act_of(const json& value, const Place& place) {
    SetMaterial act;
    std::vector<std::string> keys{"body"};
    for_each_coefficient(act, [&](const char* key, std::optional<float>&) { keys.push_back(key); });
    only(value, place, keys);
    required(value, place, "body", act.body);
    if (value.size() == 1) refuse(place, "changes no coefficient");
    for_each_coefficient(act, [&](const char* key, std::optional<float>& coefficient) {
        if (value.contains(key)) read(value[key], place / key, coefficient.emplace());
    });
    return act;
}

SetMotion motion_act_of(const json& value, const Place& place) {
    only(value, place, {"body", "motion"});
    SetMotion act;
    std::string word;
    required(value, place, "body", act.body);
    required(value, place, "motion", word);
    const auto& words = schema::words<Motion>;
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
        throw SceneError((place / "motion").pointer(), unknown("motion", word, Names(words.begin(), words.end())));
    act.motion = static_cast<Motion>(found - words.begin());
    return act;
}

template <class Act>
Act plain_act(const json& value, const Place& place) {
    Act act;
    std::apply(
        [&](const auto&... one) {
            only(value, place, {one.first...});
            (required(value, place, one.first, act.*one.second), ...);
        },
        members<Act>);
    return act;
}

Drive drive_of(const json& value, const Place& place) {
    Drive act;
    only(value, place, {"vehicle", "throttle", "brake", "steer", "hand_brake"});
    required(value, place, "vehicle", act.vehicle);
    optional(value, place, "throttle", act.controls.throttle);
    optional(value, place, "brake", act.controls.brake);
    optional(value, place, "steer", act.controls.steer);
    optional(value, place, "hand_brake", act.controls.hand_brake);
    return act;
}

UserCommand act_of(const std::string& name, const json& value, const Place& place) {
    if (name == "add") return Add{added_body(value, place)};
    if (name == "turn") return turn_of(value, place);
    if (name == "join") return Join{joint_of(value, place)};
    if (name == "drive") return drive_of(value, place);
    if (name == "set_material") return material_act_of(value, place);
    if (name == "set_motion") return motion_act_of(value, place);
    if (name == "set_mass") return plain_act<SetMass>(value, place);
    if (name == "remove") return plain_act<Remove>(value, place);
    if (name == "unjoin") return plain_act<Unjoin>(value, place);
    if (name == "grab") return plain_act<Grab>(value, place);
    if (name == "drag") return plain_act<Drag>(value, place);
    if (name == "release") return plain_act<Release>(value, place);
    if (name == "righten") return plain_act<Righten>(value, place);
    if (name == "push") return plain_act<Push>(value, place);
    return plain_act<Explode>(value, place);
}

TimedAct timed_act_of(const json& value, const Place& place) {
    if (!value.is_object()) refuse(place, "must be an object, is " + kind(value));
    TimedAct timed;
    std::size_t step = 0;
    required(value, place, "step", step);
    timed.step = step;
    if (value.size() != 2) refuse(place, "must have \"step\" and one act (" + listed(act_names) + ")");
    for (const auto& [key, inside] : value.items()) {
        if (key == "step") continue;
        if (std::find(act_names.begin(), act_names.end(), key) == act_names.end())
            throw SceneError(place.pointer() + "/" + escaped(key), unknown("act", key, act_names));
        timed.act = act_of(key, inside, place / key.c_str());
    }
    return timed;
}

void read_settings(const json& value, const Place& root, Input& input) {
    std::size_t seed = 1, substeps = static_cast<std::size_t>(Settings{}.substeps);
    optional(value, root, "bodies", input.bodies);
    optional(value, root, "seed", seed);
    optional(value, root, "rate", input.rate);
    optional(value, root, "substeps", substeps);
    optional(value, root, "sleeping", input.sleeping);
    if (!(input.rate >= 10 && input.rate <= 1000)) refuse(root / "rate", "must be between 10 and 1000 Hz");
    if (substeps < 1 || substeps > 64) refuse(root / "substeps", "must be between 1 and 64");
    input.seed = seed;
    input.substeps = static_cast<int>(substeps);
}

}  // namespace

std::string json_of(const Input& input) {
    std::string text =
        "{\"scree_input\": 1,\n \"scene\": " + json(input.scene).dump(-1, ' ', false, json::error_handler_t::replace) +
        ",\n \"bodies\": " + text_of(input.bodies) + ", \"seed\": " + text_of(input.seed) + ",\n";
    text += " \"rate\": " + text_of(input.rate) + ", \"substeps\": " + text_of(input.substeps) +
            ", \"sleeping\": " + text_of(input.sleeping) + ",\n";
    if (input.start_hash) text += " \"start_hash\": " + hexadecimal(*input.start_hash) + ",\n";
    text += " \"steps\": " + text_of(input.steps) + ",\n";
    if (input.end_hash) text += " \"end_hash\": " + hexadecimal(*input.end_hash) + ",\n";
    text += " \"acts\": [";
    const char* between = "\n  ";
    for (const TimedAct& act : input.acts) {
        text += between + ("{\"step\": " + text_of(act.step)) + ", " + std::visit(Writer{}, act.act) + "}";
        between = ",\n  ";
    }
    return text + "\n]}\n";
}

Input input_from_json(std::string_view text) {
    const json value = parsed(text);
    const Place root{nullptr, nullptr, 0};
    only(value, root, keys);
    std::size_t version = 0, steps = 0;
    required(value, root, "scree_input", version);
    if (version != 1) refuse(root / "scree_input", "is of version " + std::to_string(version) + "; this program knows 1");
    Input input;
    required(value, root, "scene", input.scene);
    required(value, root, "steps", steps);
    if (steps > most_steps) refuse(root / "steps", "must be at most " + std::to_string(most_steps));
    input.steps = steps;
    read_settings(value, root, input);
    if (value.contains("start_hash")) input.start_hash = hash_of(value["start_hash"], root / "start_hash");
    if (value.contains("end_hash")) input.end_hash = hash_of(value["end_hash"], root / "end_hash");
    if (!value.contains("acts")) refuse(root, "lacks \"acts\"");
    if (!value["acts"].is_array()) refuse(root / "acts", "must be an array, is " + kind(value["acts"]));
    const Place acts = root / "acts";
    for (std::size_t i = 0; i < value["acts"].size(); ++i) {
        input.acts.push_back(timed_act_of(value["acts"][i], acts / i));
        const std::uint64_t step = input.acts.back().step;
        if (i > 0 && step < input.acts[i - 1].step) refuse(acts / i / "step", "acts must be in the order of their steps");
        if (step > steps) refuse(acts / i / "step", "lies beyond /steps, " + std::to_string(steps));
    }
    return input;
}

}  // namespace scree::replay
