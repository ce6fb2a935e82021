// Validation of joints, and joints from world coordinates.
#include "compute/scene/validation/joint_validation.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <utility>

#include "compute/scene/double_quaternion.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/check.h"
#include "compute/schema/joint.h"

namespace scree {

namespace {

using glm::dquat;
using glm::dvec3;

using schema::Direction;

// Rules beyond the ranges of the field table.
struct Rules {
    template <class Struct>
    void operator()(const Examination&, const Struct&, Direction) const {}

    void operator()(const Examination& at, const Limits& limits, Direction) const {
        require_order(at, limits.lower, limits.upper);
    }
    void operator()(const Examination& at, const Distance& distance, Direction) const {
        require_order(at, distance.least, distance.greatest);
    }
    void operator()(const Examination& at, const Axis& axis, Direction) const {
        if (axis.locked && (axis.limits || axis.spring || axis.motor || axis.friction != 0 || axis.armature != 0))
            refuse(at, "a locked axis has no limits, spring, motor, friction or armature; leave them out, or \"locked\"");
        if (axis.motor && axis.friction != 0)
            refuse(at, "an axis has at most one of motor and friction; lower the motor's max_force by the friction");
        // Without stiffness and damping a spring exerts nothing, and keeps its limit for a drive.
        if (!axis.spring || !(axis.spring->stiffness > 0 || axis.spring->damping > 0)) return;
        if (axis.spring->max_force < unlimited && (axis.motor || axis.friction != 0))
            refuse(at / "spring" / "max_force",
                   "beside a motor or friction a spring's force has no limit; leave it out, or set stiffness and damping to 0");
        if (axis.spring->speed != 0 && (axis.motor || axis.friction != 0))
            refuse(at / "spring" / "speed", "beside a motor or friction a spring damps towards speed 0; leave it out");
    }

private:
    static void require_order(const Examination& at, float lower, float upper) {
        if (lower > upper)
            refuse(at, "the limits are reversed: lower is " + text_of(lower) + ", upper " + text_of(upper) + "; exchange them");
    }
};

// Whether a joint of that kind moves on the axis, so that a coupling can name it.
bool can_be_coupled(const JointKind& kind, JointAxis axis) {
    if (std::holds_alternative<Hinge>(kind) || std::holds_alternative<ConeTwist>(kind)) return axis == JointAxis::twist;
    if (std::holds_alternative<Slider>(kind) || std::holds_alternative<Distance>(kind)) return axis == JointAxis::x;
    const auto* const six = std::get_if<SixDof>(&kind);
    if (!six) return false;
    const Axis* const axes[] = {&six->x, &six->y, &six->z, &six->twist, &six->swing_y, &six->swing_z};
    const Axis& one = *axes[static_cast<std::size_t>(axis)];
    return !one.locked && !(one.limits && one.limits->lower == one.limits->upper);
}

void examine_coupling(const Examination& joint, Joint& j, Coupling& coupling, const Scene& scene) {
    if (j.a != the_world || j.b != the_world)
        joint.refuse(j.a != the_world ? "/a" : "/b", "a coupling joins joints, not bodies; leave a and b out");
    schema::check_fields(joint, j, Rules());
    const std::string place = "/kind/coupling";
    if (j.collide) joint.refuse("/collide", "a coupling joins no bodies that could collide; leave it out");
    if (j.anchor_a != vec3(0) || j.anchor_b != vec3(0))
        joint.refuse("", "a coupling is at no place; leave out its anchors and its axis");
    if (coupling.joints.size() > most_coupled_axes || (!coupling.curve.empty() && coupling.joints.size() > 4))
        joint.refuse(place + "/joints", "must be at most " + std::string(coupling.curve.empty() ? "8" : "4, beside a curve,") +
                                            " joints, not " + std::to_string(coupling.joints.size()));
    if (coupling.curve.size() > 4)
        joint.refuse(place + "/curve", "has at most 4 numbers, not " + std::to_string(coupling.curve.size()));
    for (std::size_t k = 0; k < coupling.curve.size(); ++k)
        if (!(std::abs(coupling.curve[k]) <= 1e6f))
            joint.refuse(place + "/curve/" + std::to_string(k), "must be within 1000000 of 0, is " + text_of(coupling.curve[k]));
    if (coupling.sum.armature != 0)
        joint.refuse(place + "/armature", "a coupling turns no rotor; give the armature to one of its joints");
    for (std::size_t t = 0; t < coupling.joints.size(); ++t) {
        const CoupledAxis& term = coupling.joints[t];
        const std::string at = place + "/joints/" + std::to_string(t);
        if (term.joint >= scene.joints.size())
            joint.refuse(at + "/joint", "there is no joint " + std::to_string(term.joint) + "; the scene has " +
                                            std::to_string(scene.joints.size()));
        const JointKind& kind = scene.joints[term.joint].kind;
        if (std::holds_alternative<Coupling>(kind))
            joint.refuse(at + "/joint",
                         "joint " + std::to_string(term.joint) + " is a coupling; name the joints that it couples");
        if (!can_be_coupled(kind, term.axis.value_or(main_axis(kind))))
            joint.refuse(term.axis ? at + "/axis" : at + "/joint",
                         "joint " + std::to_string(term.joint) +
                             " does not move on that axis alone; a hinge and a cone turn about twist, a slider and a distance "
                             "move along x, and six degrees on what is not locked");
        for (std::size_t e = 0; e < t; ++e)
            if (coupling.joints[e].joint == term.joint &&
                coupling.joints[e].axis.value_or(main_axis(kind)) == term.axis.value_or(main_axis(kind)))
                joint.refuse(at + "/joint", "is named twice; add the factors");
        if (term.factor == 0 && (coupling.curve.empty() || t + 1 < coupling.joints.size()))
            joint.refuse(at + "/factor", "must not be 0; leave the joint out");
    }
}

void examine(const Examination& joint, Joint& j, const Scene& scene) {
    if (auto* coupling = std::get_if<Coupling>(&j.kind)) return examine_coupling(joint, j, *coupling, scene);
    const auto moves = [&](std::size_t body) { return body != the_world && scene.bodies[body].motion == Motion::dynamic; };
    for (const auto& [key, body] : {std::pair{"/a", j.a}, std::pair{"/b", j.b}})
        if (body != the_world && body >= scene.bodies.size())
            joint.refuse(key,
                         "there is no body " + std::to_string(body) + "; the scene has " + std::to_string(scene.bodies.size()));
    if (j.a == j.b && j.a != the_world)
        joint.refuse("/b", "body " + std::to_string(j.a) + " is joined to itself; name another, or leave it out for the world");
    if (!moves(j.a) && !moves(j.b))
        joint.refuse("", "joins two bodies that never move; at least one of a and b must be a dynamic body");
    schema::check_fields(joint, j, Rules());
}

struct Frame {
    dvec3 position{0};
    dquat turn{1, 0, 0, 0};
};
Frame frame_of(const Scene& scene, std::size_t body) {
    if (body == the_world || body >= scene.bodies.size()) return {};
    return {dvec3(scene.bodies[body].position), glm::normalize(double_quaternion(scene.bodies[body].orientation))};
}

}  // namespace

void check_joints(Scene& scene) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i) check_joint(scene, scene.joints[i], i);
}
void check_joint(const Scene& scene, Joint& joint, std::size_t index) {
    examine(Examination("joints", "joint", index, joint.name), joint, scene);
}

void note_open_joints(const Scene& scene, std::vector<std::string>& notes) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        const Joint& joint = scene.joints[i];
        if (joint.broken || std::holds_alternative<Distance>(joint.kind)) continue;
        const Frame a = frame_of(scene, joint.a), b = frame_of(scene, joint.b);
        const dvec3 gap = (b.position + b.turn * dvec3(joint.anchor_b)) - (a.position + a.turn * dvec3(joint.anchor_a));
        const dquat axes = glm::conjugate(a.turn * glm::normalize(double_quaternion(joint.frame_a)));
        dvec3 held = axes * gap;  // along axes that do not move
        if (std::holds_alternative<Slider>(joint.kind)) held.x = 0;
        if (const auto* six = std::get_if<SixDof>(&joint.kind))
            held *= dvec3(six->x.locked ? 1 : 0, six->y.locked ? 1 : 0, six->z.locked ? 1 : 0);
        const double size = glm::length(dvec3(joint.anchor_a)) + glm::length(dvec3(joint.anchor_b));
        const double apart = glm::length(held);
        if (apart <= 1e-3 + 1e-2 * size) continue;
        notes.push_back("/joints/" + std::to_string(i) + (joint.name.empty() ? "" : " (\"" + joint.name + "\")") +
                        ": its anchors are " + text_of(static_cast<float>(apart)) +
                        " m apart at the start, and the joint pulls them together; give \"anchor\", or \"anchor_a\" and "
                        "\"anchor_b\"");
    }
}

void shift_joints(Scene& scene, std::size_t body, const glm::dvec3& centre, const glm::dquat& axes) {
    const dquat back = glm::conjugate(axes);
    for (Joint& joint : scene.joints) {
        const auto shift = [&](vec3& anchor, vec4& frame) {
            anchor = vec3(back * (dvec3(anchor) - centre));
            frame = single_quaternion(glm::normalize(back * double_quaternion(frame)));
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
    joint.kind = kind;
    joint.a = a;
    joint.b = b;
    const Frame in_a = frame_of(scene, a), in_b = frame_of(scene, b);
    joint.anchor_a = vec3(glm::conjugate(in_a.turn) * (dvec3(anchor) - in_a.position));
    joint.anchor_b = vec3(glm::conjugate(in_b.turn) * (dvec3(anchor) - in_b.position));
    joint.frame_a = single_quaternion(glm::normalize(glm::conjugate(in_a.turn) * turn));
    joint.frame_b = single_quaternion(glm::normalize(glm::conjugate(in_b.turn) * turn));
    return joint;
}

Joint joint_between(const Scene& scene, JointKind kind, std::size_t a, std::size_t b, vec3 anchor_a, vec3 anchor_b) {
    Joint joint = joint_at(scene, kind, a, b, anchor_a);
    const Frame in_b = frame_of(scene, b);
    joint.anchor_b = vec3(glm::conjugate(in_b.turn) * (dvec3(anchor_b) - in_b.position));
    return joint;
}

}  // namespace scree
