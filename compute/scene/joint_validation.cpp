// What a scene may say of its joints, and joints made where they are in the world.
#include "compute/scene/joint_validation.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>

#include "compute/scene/validator.h"

namespace scree {

namespace {

using glm::dquat;
using glm::dvec3;

constexpr float largest_anchor = 1e6f;  // m
constexpr float most_turn = 3.1415927f;
constexpr float most_stiffness = 1e12f;
constexpr float most_speed = 1e4f;

void examine(const Examination& joint, const std::string& key, const Limits& limits, bool turns) {
    const float most = turns ? most_turn : unlimited;
    joint.between(key + "/lower", limits.lower, -most, most, turns ? " rad" : " m");
    joint.between(key + "/upper", limits.upper, -most, most, turns ? " rad" : " m");
    if (limits.lower > limits.upper)
        joint.refuse(key, "the limits are reversed: lower is " + text_of(limits.lower) + ", upper " + text_of(limits.upper) +
                              "; exchange them");
}
void examine(const Examination& joint, const std::string& key, const Spring& spring) {
    joint.between(key + "/stiffness", spring.stiffness, 0, most_stiffness, "");
    joint.between(key + "/damping", spring.damping, 0, most_stiffness, "");
    joint.between(key + "/rest", spring.rest, -largest_anchor, largest_anchor, "");
    joint.between(key + "/max_force", spring.max_force, 0, unlimited, "");
}
void examine(const Examination& joint, const std::string& key, const Axis& axis, bool turns) {
    if (axis.locked && (axis.limits || axis.spring || axis.motor || axis.friction != 0))
        joint.refuse(key, "a locked axis has no limits, spring, motor or friction; leave them out, or \"locked\"");
    if (axis.limits) examine(joint, key + "/limits", *axis.limits, turns);
    if (axis.spring) examine(joint, key + "/spring", *axis.spring);
    if (axis.motor) {
        joint.between(key + "/motor/speed", axis.motor->speed, -most_speed, most_speed, turns ? " rad/s" : " m/s");
        joint.between(key + "/motor/max_force", axis.motor->max_force, 0, unlimited, turns ? " N m" : " N");
    }
    joint.between(key + "/friction", axis.friction, 0, unlimited, turns ? " N m" : " N");
    if ((axis.spring ? 1 : 0) + (axis.motor ? 1 : 0) + (axis.friction != 0 ? 1 : 0) > 1)
        joint.refuse(key, "an axis has a spring, a motor or friction, one of them; a spring's damping resists too");
}

void examine(const Examination& joint, JointKind& kind) {
    if (auto* ball = std::get_if<Ball>(&kind)) {
        joint.between("/kind/ball/friction", ball->friction, 0, unlimited, " N m");
    } else if (auto* hinge = std::get_if<Hinge>(&kind)) {
        examine(joint, "/kind/hinge", hinge->turn, true);
    } else if (auto* slider = std::get_if<Slider>(&kind)) {
        examine(joint, "/kind/slider", slider->slide, false);
    } else if (auto* distance = std::get_if<Distance>(&kind)) {
        examine(joint, "/kind/distance", Limits{distance->least, distance->greatest}, false);
        joint.between("/kind/distance/least", distance->least, 0, unlimited, " m");
        if (distance->spring) examine(joint, "/kind/distance/spring", *distance->spring);
    } else if (auto* cone = std::get_if<ConeTwist>(&kind)) {
        joint.between("/kind/cone_twist/swing", cone->swing, 0, most_turn, " rad");
        examine(joint, "/kind/cone_twist/twist", cone->twist, true);
        joint.between("/kind/cone_twist/friction", cone->friction, 0, unlimited, " N m");
    } else if (auto* six = std::get_if<SixDegrees>(&kind)) {
        const std::pair<const char*, const Axis*> axes[] = {{"x", &six->x},
                                                            {"y", &six->y},
                                                            {"z", &six->z},
                                                            {"twist", &six->twist},
                                                            {"swing_y", &six->swing_y},
                                                            {"swing_z", &six->swing_z}};
        for (std::size_t k = 0; k < 6; ++k)
            examine(joint, std::string("/kind/six_degrees/") + axes[k].first, *axes[k].second, k >= 3);
    }
}

void examine(const Examination& joint, Joint& j, const Scene& scene) {
    const auto moves = [&](std::size_t body) { return body != the_world && scene.bodies[body].motion == Motion::dynamic; };
    for (const auto& [key, body] : {std::pair{"/a", j.a}, std::pair{"/b", j.b}})
        if (body != the_world && body >= scene.bodies.size())
            joint.refuse(key,
                         "there is no body " + std::to_string(body) + "; the scene has " + std::to_string(scene.bodies.size()));
    if (j.a == j.b && j.a != the_world)
        joint.refuse("/b", "body " + std::to_string(j.a) + " is joined to itself; name another, or leave it out for the world");
    if (!moves(j.a) && !moves(j.b))
        joint.refuse("", "joins two things that never move; at least one of a and b must be a dynamic body");
    constexpr const char* turn = "a quaternion x, y, z, w turns the joint's axes; no turn is [0, 0, 0, 1]";
    joint.between("/anchor_a", j.anchor_a, -largest_anchor, largest_anchor, " m");
    joint.between("/anchor_b", j.anchor_b, -largest_anchor, largest_anchor, " m");
    joint.make_unit("/frame_a", j.frame_a, turn);
    joint.make_unit("/frame_b", j.frame_b, turn);
    joint.between("/break_force", j.break_force, 0, unlimited, " N");
    joint.between("/break_torque", j.break_torque, 0, unlimited, " N m");
    examine(joint, j.kind);
}

dquat of(vec4 q) {
    return {q.w, q.x, q.y, q.z};
}
vec4 of(dquat q) {
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

struct Frame {
    dvec3 position{0};
    dquat turn{1, 0, 0, 0};
};
Frame frame_of(const Scene& scene, std::size_t body) {
    if (body == the_world || body >= scene.bodies.size()) return {};
    return {dvec3(scene.bodies[body].position), glm::normalize(of(scene.bodies[body].orientation))};
}

}  // namespace

void check_joints(Scene& scene) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i) check_joint(scene, scene.joints[i], i);
}
void check_joint(const Scene& scene, Joint& joint, std::size_t index) {
    examine(Examination("joints", "joint", index, joint.name), joint, scene);
}

void shift_joints(Scene& scene, std::size_t body, const glm::dvec3& centre, const glm::dquat& axes) {
    const dquat back = glm::conjugate(axes);
    for (Joint& joint : scene.joints) {
        const auto shift = [&](vec3& anchor, vec4& frame) {
            anchor = vec3(back * (dvec3(anchor) - centre));
            frame = of(glm::normalize(back * of(frame)));
        };
        if (joint.a == body) shift(joint.anchor_a, joint.frame_a);
        if (joint.b == body) shift(joint.anchor_b, joint.frame_b);
    }
}

Joint joint_at(const Scene& scene, JointKind kind, std::size_t a, std::size_t b, vec3 anchor, vec3 axis) {
    if (!(glm::length(axis) > 1e-6f)) throw SceneError("", "the joint's axis has length 0; [1, 0, 0] points along x");
    const dvec3 x = glm::normalize(dvec3(axis));
    const dvec3 side = std::abs(x.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
    const dvec3 z = glm::normalize(glm::cross(x, side));
    const dquat turn = x == dvec3(1, 0, 0) ? dquat(1, 0, 0, 0) : glm::quat_cast(glm::dmat3(x, glm::cross(z, x), z));
    Joint joint;
    joint.kind = std::move(kind);
    joint.a = a;
    joint.b = b;
    const Frame in_a = frame_of(scene, a), in_b = frame_of(scene, b);
    joint.anchor_a = vec3(glm::conjugate(in_a.turn) * (dvec3(anchor) - in_a.position));
    joint.anchor_b = vec3(glm::conjugate(in_b.turn) * (dvec3(anchor) - in_b.position));
    joint.frame_a = of(glm::normalize(glm::conjugate(in_a.turn) * turn));
    joint.frame_b = of(glm::normalize(glm::conjugate(in_b.turn) * turn));
    return joint;
}

Joint joint_between(const Scene& scene, JointKind kind, std::size_t a, std::size_t b, vec3 anchor_a, vec3 anchor_b) {
    Joint joint = joint_at(scene, std::move(kind), a, b, anchor_a);
    const Frame in_b = frame_of(scene, b);
    joint.anchor_b = vec3(glm::conjugate(in_b.turn) * (dvec3(anchor_b) - in_b.position));
    return joint;
}

}  // namespace scree
