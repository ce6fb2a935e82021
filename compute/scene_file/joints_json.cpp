// Joints of a scene file: reading and writing them.
#include "compute/scene_file/joints_json.h"

#include <algorithm>
#include <map>

namespace scree {

namespace json_reading {

static void read(const json& value, const Place& place, Limits& out) {
    only(value, place, {"lower", "upper"});
    required(value, place, "lower", out.lower);
    required(value, place, "upper", out.upper);
}
static void read(const json& value, const Place& place, Spring& out) {
    only(value, place, {"stiffness", "damping", "rest", "max_force"});
    optional(value, place, "stiffness", out.stiffness);
    optional(value, place, "damping", out.damping);
    optional(value, place, "rest", out.rest);
    optional(value, place, "max_force", out.max_force);
}
static void read(const json& value, const Place& place, Motor& out) {
    only(value, place, {"speed", "max_force"});
    required(value, place, "speed", out.speed);
    required(value, place, "max_force", out.max_force);
}
static void read(const json& value, const Place& place, Axis& out) {
    only(value, place, {"locked", "limits", "spring", "motor", "friction"});
    optional(value, place, "locked", out.locked);
    if (value.contains("limits")) read(value["limits"], place / "limits", out.limits.emplace());
    if (value.contains("spring")) read(value["spring"], place / "spring", out.spring.emplace());
    if (value.contains("motor")) read(value["motor"], place / "motor", out.motor.emplace());
    optional(value, place, "friction", out.friction);
}

static const Names& kind_names() {
    static const Names names = {"ball", "hinge", "slider", "fixed", "distance", "cone_twist", "six_degrees"};
    return names;
}

static void read(const json& value, const Place& place, JointKind& out) {
    if (!value.is_object() || value.size() != 1)
        refuse(place,
               "must be an object with one key (" + listed(kind_names()) + "), such as {\"hinge\": {}}; is " + kind(value));
    const std::string& name = value.begin().key();
    const json& inner = value.begin().value();
    if (std::find(kind_names().begin(), kind_names().end(), name) == kind_names().end())
        refuse(place, "unknown kind of joint \"" + name + "\"; known: " + listed(kind_names()));
    const Place inside = place / name.c_str();
    if (name == "ball") {
        only(inner, inside, {"friction"});
        optional(inner, inside, "friction", out.emplace<Ball>().friction);
    } else if (name == "hinge") {
        read(inner, inside, out.emplace<Hinge>().turn);
    } else if (name == "slider") {
        read(inner, inside, out.emplace<Slider>().slide);
    } else if (name == "fixed") {
        only(inner, inside, {});
        out.emplace<Fixed>();
    } else if (name == "distance") {
        only(inner, inside, {"least", "greatest", "spring"});
        auto& distance = out.emplace<Distance>();
        optional(inner, inside, "least", distance.least);
        optional(inner, inside, "greatest", distance.greatest);
        if (inner.contains("spring")) read(inner["spring"], inside / "spring", distance.spring.emplace());
    } else if (name == "cone_twist") {
        only(inner, inside, {"swing", "twist", "friction"});
        auto& cone = out.emplace<ConeTwist>();
        required(inner, inside, "swing", cone.swing);
        required(inner, inside, "twist", cone.twist);
        optional(inner, inside, "friction", cone.friction);
    } else {
        only(inner, inside, {"x", "y", "z", "twist", "swing_y", "swing_z"});
        auto& six = out.emplace<SixDegrees>();
        optional(inner, inside, "x", six.x);
        optional(inner, inside, "y", six.y);
        optional(inner, inside, "z", six.z);
        optional(inner, inside, "twist", six.twist);
        optional(inner, inside, "swing_y", six.swing_y);
        optional(inner, inside, "swing_z", six.swing_z);
    }
}

}  // namespace json_reading

namespace {

using namespace json_reading;

using Bodies = std::map<std::string, std::size_t>;  // the first of each name

std::size_t body_of(const json& joint, const Place& place, const char* key, const Bodies& named) {
    const auto found = joint.find(key);
    if (found == joint.end()) return the_world;
    if (found->is_number_unsigned()) return found->get<std::size_t>();
    if (!found->is_string())
        refuse(place / key, "must be a body's index or name, or be left out for the world; is " + kind(*found));
    const auto body = named.find(found->get<std::string>());
    if (body == named.end()) {
        if (*found == "world") return the_world;
        refuse(place / key, "there is no body named " + found->dump() + "; bodies have indices from 0, or names");
    }
    return body->second;
}

Joint joint_of(const json& value, const Place& place, const Scene& scene, const Bodies& named) {
    only(value, place,
         {"name", "kind", "a", "b", "anchor", "axis", "anchor_a", "anchor_b", "frame_a", "frame_b", "collide", "break_force",
          "break_torque", "broken"});
    Joint joint;
    required(value, place, "kind", joint.kind);
    joint.a = body_of(value, place, "a", named);
    joint.b = body_of(value, place, "b", named);
    if (value.contains("anchor")) {
        for (const char* key : {"anchor_a", "anchor_b", "frame_a", "frame_b"})
            if (value.contains(key)) refuse(place / key, "\"anchor\" and \"axis\" say it already; leave it or them out");
        vec3 anchor(0), axis(1, 0, 0);
        optional(value, place, "anchor", anchor);
        optional(value, place, "axis", axis);
        try {
            joint = joint_at(scene, joint.kind, joint.a, joint.b, anchor, axis);
        } catch (const SceneError& error) {
            refuse(place / "axis", error.what());
        }
    } else if (value.contains("axis")) {
        refuse(place / "axis", "needs \"anchor\": where in the world the joint is");
    }
    optional(value, place, "name", joint.name);
    optional(value, place, "anchor_a", joint.anchor_a);
    optional(value, place, "anchor_b", joint.anchor_b);
    optional(value, place, "frame_a", joint.frame_a);
    optional(value, place, "frame_b", joint.frame_b);
    optional(value, place, "collide", joint.collide);
    optional(value, place, "break_force", joint.break_force);
    optional(value, place, "break_torque", joint.break_torque);
    optional(value, place, "broken", joint.broken);
    return joint;
}

json json_of(const Limits& limits) {
    return {{"lower", limits.lower}, {"upper", limits.upper}};
}
json json_of(const Spring& spring) {
    json made = {{"stiffness", spring.stiffness}, {"damping", spring.damping}, {"rest", spring.rest}};
    if (spring.max_force != unlimited) made["max_force"] = spring.max_force;
    return made;
}
json json_of(const Axis& axis) {
    json made = json::object();
    if (axis.locked) made["locked"] = true;
    if (axis.limits) made["limits"] = json_of(*axis.limits);
    if (axis.spring) made["spring"] = json_of(*axis.spring);
    if (axis.motor) made["motor"] = {{"speed", axis.motor->speed}, {"max_force", axis.motor->max_force}};
    if (axis.friction != 0) made["friction"] = axis.friction;
    return made;
}
json json_of(const JointKind& kind) {
    if (const auto* hinge = std::get_if<Hinge>(&kind)) return {{"hinge", json_of(hinge->turn)}};
    if (const auto* slider = std::get_if<Slider>(&kind)) return {{"slider", json_of(slider->slide)}};
    if (std::holds_alternative<Fixed>(kind)) return {{"fixed", json::object()}};
    if (const auto* distance = std::get_if<Distance>(&kind)) {
        json made = {{"least", distance->least}};
        if (distance->greatest != unlimited) made["greatest"] = distance->greatest;
        if (distance->spring) made["spring"] = json_of(*distance->spring);
        return {{"distance", made}};
    }
    if (const auto* cone = std::get_if<ConeTwist>(&kind)) {
        json made = {{"swing", cone->swing}, {"twist", json_of(cone->twist)}};
        if (cone->friction != 0) made["friction"] = cone->friction;
        return {{"cone_twist", made}};
    }
    if (const auto* six = std::get_if<SixDegrees>(&kind))
        return {{"six_degrees",
                 {{"x", json_of(six->x)},
                  {"y", json_of(six->y)},
                  {"z", json_of(six->z)},
                  {"twist", json_of(six->twist)},
                  {"swing_y", json_of(six->swing_y)},
                  {"swing_z", json_of(six->swing_z)}}}};
    const float friction = std::get<Ball>(kind).friction;
    return {{"ball", friction != 0 ? json{{"friction", friction}} : json::object()}};
}
template <glm::length_t size>
json json_of(const glm::vec<size, float>& v) {
    json made = json::array();
    for (glm::length_t i = 0; i < size; ++i) made.push_back(v[i]);
    return made;
}

}  // namespace

void read_joints(const nlohmann::json& value, Scene& scene) {
    const Place root{nullptr, nullptr, 0};
    const Place joints = root / "joints";
    if (!value.is_array()) refuse(joints, "must be an array, is " + kind(value));
    Bodies named;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (!scene.bodies[i].name.empty()) named.try_emplace(scene.bodies[i].name, i);
    for (std::size_t i = 0; i < value.size(); ++i) scene.joints.push_back(joint_of(value[i], joints / i, scene, named));
}

Joint joint_of(const nlohmann::json& value, const Place& place) {
    if (value.is_object() && value.contains("anchor"))
        refuse(place / "anchor", "its bodies move: say \"anchor_a\" and \"anchor_b\", in the frames of the bodies");
    return joint_of(value, place, Scene{}, {});
}

std::string joint_to_json(const Joint& joint) {
    // Numbers are written as doubles with all the digits that bring the float back.
    nlohmann::ordered_json made = nlohmann::ordered_json::object();
    if (!joint.name.empty()) made["name"] = joint.name;
    made["kind"] = json_of(joint.kind);
    if (joint.a != the_world) made["a"] = joint.a;
    if (joint.b != the_world) made["b"] = joint.b;
    made["anchor_a"] = json_of(joint.anchor_a);
    made["anchor_b"] = json_of(joint.anchor_b);
    if (joint.frame_a != vec4(0, 0, 0, 1)) made["frame_a"] = json_of(joint.frame_a);
    if (joint.frame_b != vec4(0, 0, 0, 1)) made["frame_b"] = json_of(joint.frame_b);
    if (joint.collide) made["collide"] = true;
    if (joint.break_force != unlimited) made["break_force"] = joint.break_force;
    if (joint.break_torque != unlimited) made["break_torque"] = joint.break_torque;
    if (joint.broken) made["broken"] = true;
    return made.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace scree
