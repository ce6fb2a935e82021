// From a model's joints to a scene's: one axis is a hinge or slider, several at one point a joint of six degrees, and what is
// neither gets light bodies between.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/double_quaternion.h"
#include "compute/scene_file/import/model.h"

namespace scree::imports {

namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double aligned = 1 - 1e-6;  // cosine between axes that count as one

dquat turn_of(const dvec3& x, const dvec3& y) {
    return glm::normalize(glm::quat_cast(dmat3(x, y, glm::cross(x, y))));
}
dvec3 any_normal(const dvec3& x) {
    const dvec3 side = std::abs(x.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
    return glm::normalize(glm::cross(side, x));
}

std::optional<Limits> limits_of(const ModelJoint& joint, double sign) {
    if (!joint.limits) return std::nullopt;
    auto [lower, upper] = *joint.limits;
    if (lower > upper) refuse(joint.origin, "the limits are reversed: the lower is above the upper");
    if (sign < 0) lower = -std::exchange(upper, -lower);
    constexpr auto most = static_cast<double>(unlimited);
    return Limits{static_cast<float>(std::clamp(lower, -most, most)), static_cast<float>(std::clamp(upper, -most, most))};
}

// The joint's behaviour along or about an axis that may point the other way.
Axis axis_of(const ModelJoint& joint, double sign, Notes& notes) {
    Axis axis;
    axis.limits = limits_of(joint, sign);
    const bool bounded = joint.greatest_force < static_cast<double>(unlimited);
    if (joint.stiffness > 0 || joint.damping > 0) {
        axis.spring = Spring{static_cast<float>(joint.stiffness), static_cast<float>(joint.damping),
                             static_cast<float>(sign * joint.rest), unlimited};
        if (bounded) axis.spring->max_force = static_cast<float>(joint.greatest_force);
    }
    if (joint.motor) axis.motor = Motor{static_cast<float>(sign) * joint.motor->speed, joint.motor->max_force};
    axis.friction = static_cast<float>(joint.friction);
    axis.armature = static_cast<float>(joint.armature);
    if (axis.friction > 0 && (axis.motor || (axis.spring && bounded))) {
        axis.friction = 0;
        notes.add(joint.origin, "friction", "is left out beside a motor of limited force");
    }
    if (axis.motor && axis.spring && bounded) axis.spring->max_force = unlimited;
    if (!(joint.effort < static_cast<double>(unlimited))) return axis;
    // A spring that exerts nothing keeps the effort for World::set_drives. Passive damping has no bound.
    if (!axis.spring && !axis.motor)
        axis.spring = Spring{.max_force = static_cast<float>(joint.effort)};
    else
        notes.add(joint.origin, "effort or forcerange",
                  "is left out beside stiffness, damping or a motor, which it does not bound; give drives a max_force");
    return axis;
}

struct Made {
    JointKind kind;
    dvec3 anchor;  // file's world, all coordinates 0
    dquat turn;
    std::optional<float> angle{};                      // at the beginning, about x
    std::vector<std::pair<JointAxis, double>> axes{};  // of each of the body's joints, with its sign; none: the kind's own
};

// A scene is told the angle of a hinge unless the poses and limits do.
std::optional<float> angle_of(const ModelJoint& joint) {
    const bool outside = joint.limits && (joint.limits->first > 0 || joint.limits->second < 0);
    if (joint.start == 0 && !outside) return std::nullopt;
    return static_cast<float>(joint.start);
}

Axis locked() {
    return {.locked = true};
}

Made ball_of(const ModelJoint& joint, const Placed& body, Notes& notes) {
    Made made{Ball{static_cast<float>(joint.friction)}, body * joint.anchor, body.turn};
    if (joint.limits) {
        const auto most = static_cast<float>(std::min(joint.limits->second, half_turn));
        if (most < 0) refuse(joint.origin, "the greatest angle of a ball joint is negative");
        notes.add(joint.origin, "range", "of a ball joint bounds its swing and its twist, each to that angle");
        if (joint.damping > 0 || joint.stiffness > 0 || joint.armature > 0)
            notes.add(joint.origin, "damping", "stiffness and armature of a ball joint with a range are left out");
        made.kind = ConeTwist{most, {-most, most}, static_cast<float>(joint.friction)};
    } else if (joint.damping > 0 || joint.stiffness > 0 || joint.armature > 0) {
        ModelJoint each = joint;
        each.kind = ModelJoint::Kind::hinge;
        each.rest = 0;
        const Axis axis = axis_of(each, 1, notes);
        made.kind = SixDof{locked(), locked(), locked(), axis, axis, axis};
    }
    return made;
}

Made single(const ModelJoint& joint, const Placed& body, Notes& notes) {
    if (joint.kind == ModelJoint::Kind::ball) return ball_of(joint, body, notes);
    const dvec3 x = body.turn * glm::normalize(joint.axis);
    const Axis axis = axis_of(joint, 1, notes);
    Made made{Hinge{axis}, body * joint.anchor, turn_of(x, any_normal(x)), angle_of(joint)};
    if (joint.kind == ModelJoint::Kind::slide) made.kind = Slider{axis}, made.angle.reset();
    return made;
}

// Slides along, and then hinges about, the axes of one frame, with one anchor: a joint of six degrees.
std::optional<Made> together(const std::vector<ModelJoint>& joints, const Placed& body, Notes& notes) {
    std::vector<const ModelJoint*> slides, hinges;
    for (const ModelJoint& joint : joints) {
        if (joint.kind == ModelJoint::Kind::ball) return std::nullopt;
        const bool slide = joint.kind == ModelJoint::Kind::slide;
        if (slide && !hinges.empty()) return std::nullopt;  // it turns with them
        if (!slide && !hinges.empty() && glm::length(joint.anchor - hinges[0]->anchor) > 1e-6) return std::nullopt;
        (slide ? slides : hinges).push_back(&joint);
    }
    if (slides.size() > 3 || hinges.size() > 3) return std::nullopt;
    const auto axis = [](const ModelJoint* joint) { return glm::normalize(joint->axis); };
    // The innermost turn is the twist about x; an outer one perpendicular to it is the swing about y.
    std::vector<dvec3> wanted;
    if (!hinges.empty()) wanted.push_back(axis(hinges.back()));
    for (std::size_t i = 0; i + 1 < hinges.size(); ++i) wanted.push_back(axis(hinges[i]));
    for (const ModelJoint* joint : slides) wanted.push_back(axis(joint));
    const dvec3 x = wanted[0];
    dvec3 y = any_normal(x);
    for (std::size_t i = wanted.size(); i-- > 1;)
        if (std::abs(glm::dot(wanted[i], x)) < 1e-6) y = wanted[i];
    y = glm::normalize(y - x * glm::dot(x, y));
    const dvec3 frame[3] = {x, y, glm::cross(x, y)};
    SixDof kind{locked(), locked(), locked(), locked(), locked(), locked()};
    Axis* const along[3] = {&kind.x, &kind.y, &kind.z};
    Axis* const about[3] = {&kind.twist, &kind.swing_y, &kind.swing_z};
    std::vector<std::pair<JointAxis, double>> places(joints.size());
    for (const auto& [group, axes] : {std::pair{&slides, along}, std::pair{&hinges, about}}) {
        for (const ModelJoint* joint : *group) {
            int found = -1;
            for (int k = 0; k < 3; ++k)
                if (std::abs(glm::dot(axis(joint), frame[k])) > aligned) found = k;
            if (found < 0 || !axes[found]->locked) return std::nullopt;
            const double sign = glm::dot(axis(joint), frame[found]) > 0 ? 1 : -1;
            *axes[found] = axis_of(*joint, sign, notes);
            const int first = static_cast<int>(group == &slides ? JointAxis::x : JointAxis::twist);
            places[static_cast<std::size_t>(joint - joints.data())] = {static_cast<JointAxis>(first + found), sign};
        }
    }
    if (hinges.size() == 3)
        notes.add(joints[0].origin, "hinges",
                  "three at one point become a joint of six degrees; limits and springs are those of its swing and twist");
    Made made{kind, body * (hinges.empty() ? joints[0] : *hinges[0]).anchor, body.turn * turn_of(x, y)};
    if (!hinges.empty()) made.angle = angle_of(*hinges.back());
    made.axes = std::move(places);
    return made;
}

struct End {  // of a joint
    std::size_t scene_body = the_world;
    Placed zero;  // the scene body's frame with all coordinates 0, file's world; of the world in the scene's: inverse root
};

End end_at(const Assembly& all, std::size_t body) {
    const std::size_t owner = all.owner[body];
    if (owner == world_body) return {the_world, inverse(all.root)};
    return {all.bodies[owner][0], all.zero[owner] * all.frames[owner]};
}

Joint connect(Assembly& all, const Made& made, const End& a, const End& b, const Origin& origin) {
    Joint joint;
    joint.kind = made.kind;
    joint.angle = made.angle;
    joint.a = a.scene_body, joint.b = b.scene_body;
    const Placed in_a = inverse(a.zero) * Placed{made.anchor, made.turn}, in_b = inverse(b.zero) * Placed{made.anchor, made.turn};
    joint.anchor_a = vec3(in_a.position), joint.anchor_b = vec3(in_b.position);
    joint.frame_a = single_quaternion(in_a.turn), joint.frame_b = single_quaternion(in_b.turn);
    all.joint_origins.push_back(origin);
    return joint;
}

void exclude(Assembly& all, std::size_t a, std::size_t b) {
    if (a == b || a == the_world || b == the_world) return;
    all.scene.exclusions.push_back({a, b});
}

void add_joints_of(Assembly& all, std::size_t index, const std::vector<ModelMotion>& starts) {
    const ModelBody& body = all.model.bodies[index];
    const End parent = end_at(all, body.parent), child = end_at(all, index);
    const auto add = [&](const Made& made, const End& a, const End& b, const std::string& name, const Origin& origin) {
        Joint joint = connect(all, made, a, b, origin);
        joint.name = name;
        joint.collide = all.model.joined_collide;
        all.scene.joints.push_back(std::move(joint));
    };
    if (!all.model.joined_to_world_collide && all.owner[body.parent] == world_body)
        for (const std::size_t fixed : all.bodies[body.parent]) exclude(all, fixed, child.scene_body);
    const auto is_at = [&](std::size_t joint, const Made& made, std::size_t k) {
        const auto [axis, sign] = made.axes.empty() ? std::pair{main_axis(made.kind), 1.0} : made.axes[k];
        all.places[{index, joint}] = {all.scene.joints.size(), axis, sign};
    };
    if (body.joints.size() == 1) {
        const Made made = single(body.joints[0], all.zero[index], all.notes);
        is_at(0, made, 0);
        return add(made, parent, child, body.joints[0].name, body.joints[0].origin);
    }
    if (const auto made = together(body.joints, all.zero[index], all.notes)) {
        for (std::size_t k = 0; k < body.joints.size(); ++k) is_at(k, *made, k);
        std::string names;
        for (const ModelJoint& joint : body.joints) names += (names.empty() ? "" : "+") + joint.name;
        return add(*made, parent, child, names, body.joints[0].origin);
    }
    all.notes.add(body.origin, "joints",
                  "that share no point and right angles get bodies of a hundredth of the mass between them");
    End before = parent;
    for (std::size_t i = 0; i < body.joints.size(); ++i) {
        End after = child;
        if (i + 1 < body.joints.size())
            after = {add_link(all, index, moved(starts[body.parent], body, true, i + 1).placed), all.zero[index]};
        const Made made = single(body.joints[i], all.zero[index], all.notes);
        is_at(i, made, 0);
        add(made, before, after, body.joints[i].name, body.joints[i].origin);
        before = after;
    }
    if (!all.model.joined_collide) exclude(all, parent.scene_body, child.scene_body);
}

void add_tie(Assembly& all, const ModelTie& tie) {
    const End a = end_at(all, tie.a), b = end_at(all, tie.b);
    if (a.scene_body == b.scene_body) refuse(tie.origin, "ties bodies that are one rigid body, or never move");
    const Placed& first = all.zero[tie.a];
    Made made{Ball{}, first * tie.anchor, first.turn};
    if (tie.welded) made.kind = Fixed{};
    Joint joint = connect(all, made, a, b, tie.origin);
    if (tie.b_in_a) {
        // As if b stood where the weld wants it.
        const Placed wanted = first * *tie.b_in_a * inverse(all.zero[tie.b]) * b.zero;
        const Placed in_b = inverse(wanted) * Placed{made.anchor, made.turn};
        joint.anchor_b = vec3(in_b.position), joint.frame_b = single_quaternion(in_b.turn);
    }
    joint.name = tie.name;
    joint.collide = true;
    all.scene.joints.push_back(std::move(joint));
}

void add_coupling(Assembly& all, const ModelCoupling& model) {
    Coupling coupling;
    coupling.offset = static_cast<float>(model.offset);
    for (const ModelCoupling::Term& term : model.terms) {
        const auto found = all.places.find({term.body, term.joint});
        if (found == all.places.end()) refuse(model.origin, "is of a joint of what never moves");
        const Assembly::JointPlace& at = found->second;
        coupling.joints.push_back({at.joint, static_cast<float>(at.sign * term.factor), at.axis});
        double sign = at.sign;
        coupling.curve.clear();
        for (const double one : model.curve) {
            coupling.curve.push_back(static_cast<float>(sign * one));
            sign *= at.sign;
        }
    }
    if (!model.locked) coupling.sum = axis_of(model.sum, 1, all.notes);
    Joint joint;
    joint.name = model.name;
    joint.kind = coupling;
    all.joint_origins.push_back(model.origin);
    all.scene.joints.push_back(std::move(joint));
}

}  // namespace

void add_joints(Assembly& all) {
    const std::vector<ModelMotion> starts = motions_of(all.model, true);
    for (std::size_t b = 1; b < all.model.bodies.size(); ++b)
        if (!all.model.bodies[b].joints.empty()) add_joints_of(all, b, starts);
    for (const ModelTie& tie : all.model.ties) add_tie(all, tie);
    for (const ModelCoupling& coupling : all.model.couplings) add_coupling(all, coupling);
    for (const auto& [first, second] : all.model.exclusions)
        for (const std::size_t a : all.bodies[first])
            for (const std::size_t b : all.bodies[second]) exclude(all, a, b);
}

}  // namespace scree::imports
