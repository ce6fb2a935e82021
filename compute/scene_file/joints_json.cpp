// Joints of a scene file: anchors in world coordinates, and bodies by name.
#include "compute/scene_file/joints_json.h"

#include "compute/schema/joint.h"

namespace scree {

namespace json_reading {

std::size_t index_of(const json& value, const Place& place, schema::Refers refers, bool or_world, const NamedThings& named) {
    const std::string what = refers == schema::Refers::to_body ? "body" : "joint";
    if (value.is_number_unsigned()) return value.get<std::size_t>();
    if (!value.is_string())
        refuse(place, "must be a " + what + "'s index or name" + (or_world ? ", or be left out for the world; is " : ", is ") +
                          kind(value));
    const Numbers& numbers = refers == schema::Refers::to_body ? named.bodies : named.joints;
    const auto found = numbers.find(value.get<std::string>());
    if (found != numbers.end() && !found->second.namesake) return found->second.index;
    if (found == numbers.end() && or_world && value == "world") return the_world;
    const std::string name = value.dump(-1, ' ', false, json::error_handler_t::replace);
    const std::string things = refers == schema::Refers::to_body ? "bodies" : "joints";
    if (found != numbers.end())
        refuse(place, name + " names " + things + " " + std::to_string(found->second.index) + " and " +
                          std::to_string(*found->second.namesake) + "; give an index, or each a name of its own");
    refuse(place, "there is no " + what + " named " + name + "; " + things + " have indices from 0, or names");
}

}  // namespace json_reading

namespace {

using namespace json_reading;
using schema::JointPlacement;

// Converts "anchor" and "axis" (world coordinates) to anchors and frames.
void place_joint(const json& value, const Place& place, const Scene& scene, Joint& joint) {
    if (!value.contains("anchor")) {
        if (value.contains("axis")) refuse(place / "axis", "needs \"anchor\": the joint's position in world coordinates");
        return;
    }
    for (const char* key : {"anchor_a", "anchor_b", "frame_a", "frame_b"})
        if (value.contains(key)) refuse(place / key, "is given by \"anchor\" and \"axis\" already; remove it or them");
    JointPlacement world;
    read_fields(value, place, world);
    try {
        const Joint placed = joint_at(scene, joint.kind, joint.a, joint.b, world.anchor, world.axis);
        joint.anchor_a = placed.anchor_a;
        joint.anchor_b = placed.anchor_b;
        joint.frame_a = placed.frame_a;
        joint.frame_b = placed.frame_b;
    } catch (const SceneError& error) {
        refuse(place / "axis", error.what());
    }
}

Joint joint_of(const json& value, const Place& place, const NamedThings& named, const Scene& scene) {
    static const Names known = [] {
        Names keys = keys_of<Joint>();
        keys.insert(keys.end(), keys_of<JointPlacement>().begin(), keys_of<JointPlacement>().end());
        return keys;
    }();
    only(value, place, known);
    Joint joint;
    read_fields(value, place, joint, named);
    place_joint(value, place, scene, joint);
    return joint;
}

}  // namespace

void read_joints(const nlohmann::json& value, NamedThings& named, Scene& scene) {
    const Place root{nullptr, nullptr, 0};
    const Place joints = root / "joints";
    if (!value.is_array()) refuse(joints, "must be an array, is " + kind(value));
    named.joints = numbers_of(scene.joints);
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!value[i].is_object() || !value[i].contains("name") || !value[i]["name"].is_string()) continue;
        const std::string name = value[i]["name"];
        const std::size_t index = scene.joints.size() + i;
        if (const auto [known, is_new] = named.joints.try_emplace(name, Named{index}); !is_new) known->second.namesake = index;
    }
    named.joints.erase("");
    for (std::size_t i = 0; i < value.size(); ++i) scene.joints.push_back(joint_of(value[i], joints / i, named, scene));
}

Joint joint_of(const nlohmann::json& value, const Place& place) {
    if (value.is_object() && value.contains("anchor"))
        refuse(place / "anchor", "its bodies move: say \"anchor_a\" and \"anchor_b\", in the frames of the bodies");
    return joint_of(value, place, {}, Scene{});
}

}  // namespace scree
