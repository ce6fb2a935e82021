// World: joints, their state and motors.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "compute/compile/joint_blocks.h"
#include "compute/compile/state_editor.h"
#include "compute/scene/error_reason.h"
#include "compute/scene/validation/joint_validation.h"
#include "compute/world/world_impl.h"

namespace scree {

namespace {

// The axis of a joint kind that has explicit axes; else null.
Axis* axis_of(JointKind& kind, JointAxis axis) {
    if (auto* hinge = std::get_if<Hinge>(&kind)) return axis == JointAxis::twist ? &hinge->turn : nullptr;
    if (auto* slider = std::get_if<Slider>(&kind)) return axis == JointAxis::x ? &slider->slide : nullptr;
    if (auto* coupling = std::get_if<Coupling>(&kind)) return axis == JointAxis::x ? &coupling->sum : nullptr;
    auto* six = std::get_if<SixDof>(&kind);
    if (!six) return nullptr;
    Axis* const axes[] = {&six->x, &six->y, &six->z, &six->twist, &six->swing_y, &six->swing_z};
    return axes[static_cast<std::size_t>(axis)];
}

}  // namespace

std::string name_of(const Joint& joint, std::size_t index) {
    return "joint " + std::to_string(index) + (joint.name.empty() ? "" : " (\"" + joint.name + "\")");
}

void World::Impl::require_joint_index(std::size_t joint) const {
    if (joint < scene.joints.size()) return;
    throw std::out_of_range("joint " + std::to_string(joint) + " of " + std::to_string(scene.joints.size()));
}

void World::Impl::require_joint(std::size_t joint) const {
    require_joint_index(joint);
    if (is_joint_gone(joint)) throw std::out_of_range(name_of(scene.joints[joint], joint) + " has been removed");
}

JointState World::Impl::joint_state(std::size_t i) const {
    const physics::Joint& record = state.joints[state.joint_records[i]];
    JointState found;
    found.force = record.force;
    found.torque = record.torque;
    found.max_force = record.max_force;
    found.max_torque = record.max_torque;
    found.broken = record.broken != 0;
    if ((record.flags & physics::JOINT_COUPLES) != 0) {
        const CouplingState coupled = coupling_state(state, record);
        found.coordinates[0] = coupled.coordinate;
        found.rates[0] = coupled.rate;
        return found;
    }
    const physics::JointConfiguration at = configuration_of(state, record);
    found.gap = glm::length(at.gap);
    const float coordinates[] = {
        glm::dot(at.x, at.gap), glm::dot(at.y, at.gap), glm::dot(at.z, at.gap), at.turned, at.swing_y, at.swing_z};
    const JointAxes axes = axes_of_kind(scene.joints[i].kind);
    for (std::size_t k = 0; k < 6; ++k) found.coordinates[axes.of_record(k)] = coordinates[k];
    if (record.flags & physics::JOINT_RADIAL) found.coordinates[0] = found.gap;
    // As the coordinates are: of a cone those of both swings, and of a distance y and z across it.
    const physics::uint flags = record.flags & ~(physics::JOINT_CONE | physics::JOINT_RADIAL);
    for (physics::uint k = 0; k < 6; ++k)
        found.rates[axes.of_record(k)] =
            speed_of_axis(state, record, k, at, k == 0 ? record.flags & ~physics::JOINT_CONE : flags);
    return found;
}

// Changes the scene, so that snapshots have it, and the runner's joints. All is checked first.
void World::Impl::set_axes(std::span<const AxisChange> changes) {
    if (changes.empty()) return;
    std::map<std::size_t, Joint> changed;
    for (const AxisChange& one : changes) {
        require_joint(one.joint);
        Joint& joint = changed.try_emplace(one.joint, scene.joints[one.joint]).first->second;
        Axis* const found = axis_of(joint.kind, one.axis);
        if (!found || found->locked) {
            throw std::invalid_argument(
                name_of(joint, one.joint) +
                " has nothing to drive on that axis; a hinge turns about twist, a slider moves along x, and six "
                "degrees on what is not locked");
        }
        one.change(*found);
    }
    TableRanges ranges;
    for (auto& [index, joint] : changed) {
        check_joint(scene, joint, index);
        ranges.push_back({Table::joints, state.joint_records[index], 1});
    }
    edits.clear();
    runner->download(ranges);
    for (const auto& [index, joint] : changed) scene.joints[index].kind = joint.kind;
    for (const AxisChange& one : changes) {
        const JointAxes axes = axes_of_kind(scene.joints[one.joint].kind);
        const std::size_t k = axes.in_record(static_cast<std::size_t>(one.axis));
        physics::Joint& record = state.joints[state.joint_records[one.joint]];
        set_axis_record(record, axes, k);
        record.rotors[k].inertia = rotor_record(axes.axes[k]).inertia;
    }
    runner->upload(ranges);
    for (const auto& [index, joint] : changed) wake(joint);
}

void World::Impl::wake(const Joint& joint) {
    for (const std::size_t body : {joint.a, joint.b})
        if (body != the_world && scene.bodies[body].motion == Motion::dynamic) action_on(body, vec3(0), vec3(0));
    if (const auto* coupling = std::get_if<Coupling>(&joint.kind))
        for (const CoupledAxis& term : coupling->joints) wake(scene.joints[term.joint]);
}

JointState World::joint(std::size_t index) const {
    whole().require_joint_index(index);
    whole().bring(body_ranges);
    whole().bring(joint_ranges);
    return whole().joint_state(index);
}

std::vector<JointState> World::joints() const {
    whole().bring(body_ranges);
    whole().bring(joint_ranges);
    std::vector<JointState> all;
    for (std::size_t i = 0; i < whole().scene.joints.size(); ++i) all.push_back(whole().joint_state(i));
    return all;
}

void World::set_motors(std::span<const JointMotor> motors) {
    std::vector<Impl::AxisChange> changes;
    for (const JointMotor& one : motors)
        changes.push_back({one.joint, one.axis, [motor = one.motor](Axis& axis) {
                               axis.friction = 0;
                               axis.motor = motor;
                               if (axis.spring && motor.max_force == 0) axis.motor.reset();
                           }});
    whole().set_axes(changes);
}

void World::set_springs(std::span<const JointSpring> springs) {
    std::vector<Impl::AxisChange> changes;
    for (const JointSpring& one : springs)
        changes.push_back({one.joint, one.axis, [spring = one.spring](Axis& axis) { axis.spring = spring; }});
    whole().set_axes(changes);
}

void World::set_motor(std::size_t joint, JointAxis axis, const Motor& motor) {
    const JointMotor one{joint, axis, motor};
    set_motors({&one, 1});
}

void World::set_spring(std::size_t joint, JointAxis axis, const Spring& spring) {
    const JointSpring one{joint, axis, spring};
    set_springs({&one, 1});
}

void World::set_drives(std::span<const JointDrive> drives) {
    std::vector<Impl::AxisChange> changes;
    for (const JointDrive& drive : drives)
        changes.push_back({drive.joint, drive.axis, [drive](Axis& axis) {
                               Spring spring = axis.spring.value_or(Spring{});
                               spring.stiffness = drive.stiffness.value_or(spring.stiffness);
                               spring.damping = drive.damping.value_or(spring.damping);
                               spring.rest = drive.target.value_or(spring.rest);
                               spring.speed = drive.target_speed.value_or(spring.speed);
                               spring.max_force = drive.max_force.value_or(spring.max_force);
                               axis.spring = spring;
                               axis.motor.reset();
                               const bool acts = spring.stiffness > 0 || spring.damping > 0;
                               if (acts && (spring.max_force < unlimited || spring.speed != 0)) axis.friction = 0;
                           }});
    whole().set_axes(changes);
}

Axis World::joint_axis(std::size_t joint, JointAxis axis) const {
    whole().require_joint_index(joint);
    const JointAxes axes = axes_of_kind(whole().scene.joints[joint].kind);
    return axes.axes[axes.in_record(static_cast<std::size_t>(axis))];
}

void World::set_joint_coordinates(std::span<const JointCoordinate> coordinates) {
    whole().set_joint_coordinates(coordinates);
}

JointAxis main_axis(const JointKind& kind) {
    const bool along =
        std::holds_alternative<Slider>(kind) || std::holds_alternative<Distance>(kind) || std::holds_alternative<Coupling>(kind);
    return along ? JointAxis::x : JointAxis::twist;
}

void World::apply_joint_forces(std::span<const JointForce> forces) {
    Impl& in = whole();
    TableRanges poses;
    for (const JointForce& one : forces) {
        in.require_joint(one.joint);
        const Joint& joint = in.scene.joints[one.joint];
        if (!std::isfinite(one.force)) throw std::invalid_argument(name_of(joint, one.joint) + ": the force is not finite");
        const auto take_poses = [&](const Joint& of) {
            for (const std::size_t body : {of.a, of.b})
                if (body != the_world) poses.push_back({Table::poses, in.state.row_of(body), 1});
        };
        take_poses(joint);
        const auto* coupling = std::get_if<Coupling>(&joint.kind);
        if (!coupling) continue;
        for (const CoupledAxis& term : coupling->joints) take_poses(in.scene.joints[term.joint]);
        poses.push_back({Table::joints, in.state.joint_records[one.joint], 1});
    }
    in.runner->download(poses);
    for (const JointForce& one : forces) in.apply_joint_force(one);
}

void World::Impl::apply_joint_force(const JointForce& one) {
    const physics::Joint& record = state.joints[state.joint_records[one.joint]];
    if (const auto* coupling = std::get_if<Coupling>(&scene.joints[one.joint].kind)) {
        for (std::size_t t = 0; t < coupling->joints.size(); ++t) {
            const CoupledAxis& term = coupling->joints[t];
            const float factor = (t < 4 ? record.frame_a : record.frame_b)[static_cast<int>(t % 4)];
            apply_joint_force({term.joint, term.axis.value_or(main_axis(scene.joints[term.joint].kind)), factor * one.force});
        }
        return;
    }
    const auto pose = [&](physics::uint body) {
        return body == physics::NONE ? physics::Pose{vec3(0), 0, vec4(0, 0, 0, 1)} : state.poses[body];
    };
    const physics::Pose a = pose(record.a), b = pose(record.b);
    const physics::JointConfiguration at = configuration_of(record, a, b, state.fixed());
    const std::size_t k = axes_of_kind(scene.joints[one.joint].kind).in_record(static_cast<std::size_t>(one.axis));
    vec3 axis = k % 3 == 0 ? at.x : (k % 3 == 1 ? at.y : at.z);
    const bool radial = (record.flags & physics::JOINT_RADIAL) != 0u && k == 0;
    if (radial && glm::length(at.gap) > 1e-6f) axis = glm::normalize(at.gap);
    const vec3 push = axis * one.force;
    // Both act where B's anchor is, so no angular momentum comes from nothing.
    const vec3 point = b.position + physics::rotate(b.orientation, record.anchor_b);
    const Joint& joint = scene.joints[one.joint];
    const auto act = [&](std::size_t body, vec3 centre, float sign) {
        if (body == the_world || scene.bodies[body].motion != Motion::dynamic) return;
        physics::Action& action = action_on(body, push, point);
        if (k < 3) action.force += sign * push;
        action.torque += k < 3 ? glm::cross(point - centre, sign * push) : sign * push;
    };
    act(joint.a, a.position, -1);
    act(joint.b, b.position, 1);
}

void World::Impl::rejoin(std::optional<std::size_t> without, std::span<const std::size_t> fresh) {
    edits.clear();
    StateEditor editor(state);
    runner->download(editor.needed_to_rejoin(scene, fresh));
    const TableRanges changed = editor.rejoin(scene, without, fresh);
    runner->adapt();
    runner->upload(changed);
    if (events.settings().breaks) events.note_joints(scene, state);
}

std::vector<std::size_t> World::Impl::couplings_of(std::span<const std::size_t> joints) const {
    std::vector<std::size_t> found;
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
        const auto* coupling = std::get_if<Coupling>(&scene.joints[j].kind);
        if (!coupling || is_joint_gone(j)) continue;
        if (std::any_of(coupling->joints.begin(), coupling->joints.end(), [&](const CoupledAxis& term) {
                return std::find(joints.begin(), joints.end(), term.joint) != joints.end();
            }))
            found.push_back(j);
    }
    return found;
}
void World::Impl::require_uncoupled(std::span<const std::size_t> joints) const {
    for (const std::size_t coupling : couplings_of(joints))
        if (std::find(joints.begin(), joints.end(), coupling) == joints.end())
            throw std::invalid_argument(name_of(scene.joints[coupling], coupling) +
                                        " couples a joint that is to be removed; remove the coupling, too");
}

void World::Impl::count_joints() {
    joints_gone.resize(scene.joints.size());
    while (joint_births.size() < scene.joints.size()) joint_births.push_back(births++);
}

// Messages name them by their place among these.
void World::Impl::check_new_joints(std::span<const std::size_t> joints) {
    if (state.changes_motions()) bring(body_ranges);
    if (is_stretching(state.fixed()))
        throw SceneError("/joints/0", "the periodic cell stretches (World::set_cell_rate), which none with joints can");
    for (std::size_t i = 0; i < joints.size(); ++i) {
        Joint& joint = scene.joints[joints[i]];
        check_joint(scene, joint, i);
        for (const auto& [key, body] : {std::pair{"/a", joint.a}, std::pair{"/b", joint.b}})
            if (body != the_world && (is_gone(body) || physics::is_absent(state.properties[state.row_of(body)].motion)))
                throw SceneError("/joints/" + std::to_string(i) + key,
                                 "body " + std::to_string(body) +
                                     (is_gone(body) ? " has been removed"
                                                    : " is not there: it has broken, or is a piece of one that has not"));
        if (const auto* coupling = std::get_if<Coupling>(&joint.kind))
            for (std::size_t t = 0; t < coupling->joints.size(); ++t)
                if (is_joint_gone(coupling->joints[t].joint) &&
                    std::find(joints.begin(), joints.end(), coupling->joints[t].joint) == joints.end())
                    throw SceneError("/joints/" + std::to_string(i) + "/kind/coupling/joints/" + std::to_string(t) + "/joint",
                                     "joint " + std::to_string(coupling->joints[t].joint) + " has been removed");
    }
    try {
        check_couplings(scene);
    } catch (const SceneError& error) {
        throw SceneError("/joints/0", reason_of(error));
    }
}

std::size_t World::add_joint(const Joint& joint) {
    Impl& in = whole();
    in.require_one_copy("add_joint");
    in.count_joints();
    const std::size_t index = in.scene.joints.size();
    in.scene.joints.push_back(joint);
    try {
        in.check_new_joints({&index, 1});
    } catch (const SceneError& error) {
        in.scene.joints.pop_back();
        const std::string first = "/joints/0";
        throw SceneError("/joints/" + std::to_string(index) + error.pointer.substr(first.size()), reason_of(error));
    }
    in.count_joints();
    in.rejoin();
    in.wake(in.scene.joints[index]);
    return index;
}

std::vector<JointHandle> World::add_joints(std::span<const Joint> given) {
    if (given.empty()) return {};
    Impl& in = whole();
    in.require_one_copy("add_joints");
    const std::vector<Joint> joints(given.begin(), given.end());  // they may be of the scene, which grows
    in.count_joints();
    const std::size_t before = in.scene.joints.size();
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < before && indices.size() < joints.size(); ++i)
        if (in.is_joint_gone(i)) indices.push_back(i);
    while (indices.size() < joints.size()) {
        indices.push_back(in.scene.joints.size());
        in.scene.joints.emplace_back();
    }
    std::vector<Joint> replaced;
    for (std::size_t i = 0; i < joints.size(); ++i) replaced.push_back(std::exchange(in.scene.joints[indices[i]], joints[i]));
    try {
        in.check_new_joints(indices);
    } catch (const SceneError&) {
        for (std::size_t i = 0; i < joints.size(); ++i) in.scene.joints[indices[i]] = std::move(replaced[i]);
        in.scene.joints.resize(before);
        throw;
    }
    in.count_joints();
    std::vector<JointHandle> handles;
    for (const std::size_t index : indices) {
        if (in.joints_gone[index]) in.joint_births[index] = in.births++;
        in.joints_gone[index] = 0;
        handles.push_back({static_cast<std::uint32_t>(index), in.joint_births[index]});
    }
    in.rejoin(std::nullopt, indices);
    for (const Joint& joint : joints) in.wake(joint);
    return handles;
}

void World::remove_joint(std::size_t index) {
    Impl& in = whole();
    in.require_one_copy("remove_joint");
    in.require_joint(index);
    in.require_no_wheel(index);
    in.count_joints();
    in.require_uncoupled({&index, 1});
    in.wake(in.scene.joints[index]);
    for (Vehicle& vehicle : in.scene.vehicles)
        for (Wheel& wheel : vehicle.wheels) wheel.joint -= wheel.joint > index;
    for (Joint& joint : in.scene.joints)
        if (auto* coupling = std::get_if<Coupling>(&joint.kind))
            for (CoupledAxis& term : coupling->joints) term.joint -= term.joint > index;
    const auto place = static_cast<std::ptrdiff_t>(index);
    in.scene.joints.erase(in.scene.joints.begin() + place);
    in.joint_births.erase(in.joint_births.begin() + place);
    in.joints_gone.erase(in.joints_gone.begin() + place);
    in.rejoin(index);
}

void World::remove_joints(std::span<const JointHandle> joints) {
    Impl& in = whole();
    in.require_one_copy("remove_joints");
    std::vector<std::size_t> indices;
    for (const JointHandle& joint : joints) {
        indices.push_back(index_of(joint));
        in.require_no_wheel(indices.back());
    }
    std::sort(indices.begin(), indices.end());
    if (const auto twice = std::adjacent_find(indices.begin(), indices.end()); twice != indices.end())
        throw std::invalid_argument(name_of(in.scene.joints[*twice], *twice) + " is named twice");
    in.count_joints();
    in.require_uncoupled(indices);
    TableRanges records;
    for (const std::size_t index : indices) records.push_back({Table::joints, in.state.joint_records[index], 1});
    in.runner->download(records);
    for (const std::size_t index : indices) {
        in.wake(in.scene.joints[index]);
        in.take_away_joint(index);
    }
    in.runner->upload(records);
    in.edits.clear();
}

// Its record must be here.
void World::Impl::take_away_joint(std::size_t joint) {
    scene.joints[joint].broken = true;
    state.joints[state.joint_records[joint]].broken = 1;
    joints_gone[joint] = 1;
    events.forget_joint(joint);
}

JointHandle World::joint_handle_of(std::size_t joint) const {
    whole().require_joint(joint);
    whole().count_joints();
    return {static_cast<std::uint32_t>(joint), whole().joint_births[joint]};
}

bool World::is_valid(JointHandle joint) const {
    return whole().place_of_joint(joint).has_value();
}

std::size_t World::index_of(JointHandle joint) const {
    if (const auto index = whole().place_of_joint(joint)) return *index;
    throw std::out_of_range("joint " + std::to_string(joint.index) + " of birth " + std::to_string(joint.birth) +
                            (joint.birth < whole().births ? " has been removed" : " has never been"));
}

// remove_joint moves higher ones down.
std::optional<std::size_t> World::Impl::place_of_joint(const JointHandle& joint) {
    count_joints();
    std::size_t index = joint.index;
    if (index >= joint_births.size() || joint_births[index] != joint.birth)
        index = static_cast<std::size_t>(std::find(joint_births.begin(), joint_births.end(), joint.birth) - joint_births.begin());
    if (index >= joint_births.size() || joints_gone[index]) return std::nullopt;
    return index;
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
