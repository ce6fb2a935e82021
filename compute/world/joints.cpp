// World: joints, their state and motors.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "compute/scene/joint_validation.h"
#include "compute/step/joint_blocks.h"
#include "compute/step/state_editor.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/solve/joint.h"

namespace scree {

namespace {

// The axis of a joint kind that has explicit axes; else null.
Axis* axis_of(JointKind& kind, JointAxis axis) {
    if (auto* hinge = std::get_if<Hinge>(&kind)) return axis == JointAxis::twist ? &hinge->turn : nullptr;
    if (auto* slider = std::get_if<Slider>(&kind)) return axis == JointAxis::x ? &slider->slide : nullptr;
    auto* six = std::get_if<SixDof>(&kind);
    if (!six) return nullptr;
    Axis* const axes[] = {&six->x, &six->y, &six->z, &six->twist, &six->swing_y, &six->swing_z};
    return axes[static_cast<std::size_t>(axis)];
}

std::string name_of(const Joint& joint, std::size_t index) {
    return "joint " + std::to_string(index) + (joint.name.empty() ? "" : " (\"" + joint.name + "\")");
}

}  // namespace

void World::Impl::require_joint(std::size_t joint) const {
    if (joint < scene.joints.size()) return;
    throw std::out_of_range("joint " + std::to_string(joint) + " of " + std::to_string(scene.joints.size()));
}

JointState World::Impl::joint_state(std::size_t i) const {
    const physics::Joint& record = state.joints[state.joint_records[i]];
    JointState found;
    found.force = record.force;
    found.torque = record.torque;
    found.max_force = record.max_force;
    found.max_torque = record.max_torque;
    found.broken = record.broken != 0;
    const auto pose = [&](physics::uint body) {
        return body == physics::NONE ? physics::Pose{vec3(0), 0, vec4(0, 0, 0, 1)} : state.poses[body];
    };
    const physics::JointConfiguration at = physics::joint_configuration(record.anchor_a, record.frame_a, pose(record.a),
                                                                        record.anchor_b, record.frame_b, pose(record.b));
    found.gap = glm::length(at.gap);
    found.coordinates = {
        glm::dot(at.x, at.gap), glm::dot(at.y, at.gap), glm::dot(at.z, at.gap), at.twist, at.swing_y, at.swing_z};
    if (record.flags & physics::JOINT_RADIAL) found.coordinates[0] = found.gap;
    return found;
}

// Changes the scene, so that snapshots have it, and the runner's joint.
void World::Impl::set_axis(std::size_t index, JointAxis axis, const std::function<void(Axis&)>& change) {
    require_joint(index);
    Joint& joint = scene.joints[index];
    Joint changed = joint;
    Axis* const found = axis_of(changed.kind, axis);
    if (!found || found->locked) {
        throw std::invalid_argument(
            name_of(joint, index) +
            " has nothing to drive on that axis; a hinge turns about twist, a slider moves along x, and six "
            "degrees on what is not locked");
    }
    change(*found);
    check_joint(scene, changed, index);
    joint.kind = changed.kind;
    edits.clear();
    const std::uint32_t record = state.joint_records[index];
    const TableRange range{Table::joints, record, 1};
    runner->download({range});
    const auto k = static_cast<std::size_t>(axis);
    state.joints[record].axes[k] = axis_record(axes_of_kind(joint.kind).axes[k]);
    runner->upload({range});
    wake(joint);
}

void World::Impl::wake(const Joint& joint) {
    for (const std::size_t body : {joint.a, joint.b})
        if (body != the_world && scene.bodies[body].motion == Motion::dynamic) action_on(body, vec3(0), vec3(0));
}

JointState World::joint(std::size_t index) const {
    interior_->require_joint(index);
    interior_->bring(body_ranges);
    interior_->bring(joint_ranges);
    return interior_->joint_state(index);
}

std::vector<JointState> World::joints() const {
    interior_->bring(body_ranges);
    interior_->bring(joint_ranges);
    std::vector<JointState> all;
    for (std::size_t i = 0; i < interior_->scene.joints.size(); ++i) all.push_back(interior_->joint_state(i));
    return all;
}

void World::set_motor(std::size_t joint, JointAxis axis, const Motor& motor) {
    interior_->set_axis(joint, axis, [&](Axis& a) {
        a.spring.reset();
        a.friction = 0;
        a.motor = motor;
    });
}

void World::set_spring(std::size_t joint, JointAxis axis, const Spring& spring) {
    interior_->set_axis(joint, axis, [&](Axis& a) {
        a.motor.reset();
        a.friction = 0;
        a.spring = spring;
    });
}

void World::Impl::rejoin(std::optional<std::size_t> without) {
    edits.clear();
    StateEditor editor(state);
    runner->download(editor.needed_to_rejoin());
    const TableRanges changed = editor.rejoin(scene, without);
    runner->adapt();
    runner->upload(changed);
    if (events.settings().breaks) events.note_joints(scene, state);
}

std::size_t World::add_joint(const Joint& joint) {
    Impl& in = *interior_;
    const std::size_t index = in.scene.joints.size();
    in.scene.joints.push_back(joint);
    try {
        check_joint(in.scene, in.scene.joints[index], index);
        for (const auto& [key, body] : {std::pair{"/a", joint.a}, std::pair{"/b", joint.b}})
            if (body != the_world && !this->body(body).exists)
                throw SceneError(
                    "/joints/" + std::to_string(index) + key,
                    "body " + std::to_string(body) + " is not there: it has broken, or is a piece of one that has not");
    } catch (const SceneError&) {
        in.scene.joints.pop_back();
        const std::string first = "/joints/0";
        throw SceneError("/joints/" + std::to_string(index) + error.pointer.substr(first.size()),
                         std::string(error.what()).substr(error.pointer.size() + 2));
    }
    in.rejoin();
    in.wake(joint);
    return index;
}

void World::remove_joint(std::size_t index) {
    Impl& in = *interior_;
    in.require_joint(index);
    in.require_no_wheel(index);
    in.wake(in.scene.joints[index]);
    for (Vehicle& vehicle : in.scene.vehicles)
        for (Wheel& wheel : vehicle.wheels) wheel.joint -= wheel.joint > index;
    in.scene.joints.erase(in.scene.joints.begin() + static_cast<std::ptrdiff_t>(index));
    in.rejoin(index);
}

Joint World::joint_at(const JointKind& kind, std::size_t a, std::size_t b, vec3 anchor, vec3 axis) const {
    Scene two;  // only poses matter
    const auto placed = [&](std::size_t index) {
        if (index == the_world) return the_world;
        const BodyState now = body(index);
        Body& one = two.bodies.emplace_back();
        one.position = now.position;
        one.orientation = now.orientation;
        return two.bodies.size() - 1;
    };
    const std::size_t place_a = placed(a), place_b = placed(b);
    Joint joint = scree::joint_at(two, kind, place_a, place_b, anchor, axis);
    joint.a = a;
    joint.b = b;
    return joint;
}

}  // namespace scree
