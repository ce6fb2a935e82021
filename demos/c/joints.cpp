// The C interface: joints and vehicles of a world.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "demos/c/json.h"
#include "demos/c/objects.h"

namespace scree::c {

using namespace json_reading;

namespace {

std::vector<std::size_t> joints_of(const World& world, const std::int64_t* joints, std::size_t count) {
    return indices_of(joints, count, world.scene().joints.size(), "joint");
}

void require_axis(int axis) {
    if (axis < -1 || axis > 5)
        refuse("axis: must be 0 to 5 (along x, y, z; twist, swing_y, swing_z), or -1, is " + std::to_string(axis));
}

// -1: that along or about which the joint moves.
JointAxis axis_of(const World& world, std::size_t joint, int axis) {
    return axis < 0 ? main_axis(world.scene().joints[joint].kind) : static_cast<JointAxis>(axis);
}

// Infinite forces are unlimited.
float bounded(float force) {
    return force == std::numeric_limits<float>::infinity() ? unlimited : force;
}

scree_joint_state record_of(const JointState& state, const Joint& joint) {
    scree_joint_state made{};
    for (int k = 0; k < 3; ++k) {
        made.force[k] = state.force[k];
        made.torque[k] = state.torque[k];
    }
    made.max_force = state.max_force;
    made.max_torque = state.max_torque;
    made.gap = state.gap;
    std::copy(state.coordinates.begin(), state.coordinates.end(), made.coordinates);
    std::copy(state.rates.begin(), state.rates.end(), made.rates);
    made.broken = state.broken ? 1 : 0;
    made.axis = static_cast<std::uint32_t>(main_axis(joint.kind));
    return made;
}

scree_drive record_of(const Axis& axis) {
    const Spring spring = axis.spring.value_or(Spring{});
    const Motor motor = axis.motor.value_or(Motor{});
    const Limits limits = axis.limits.value_or(Limits{-unlimited, unlimited});
    const auto bound = [](float value) {
        return std::abs(value) >= unlimited ? std::copysign(std::numeric_limits<float>::infinity(), value) : value;
    };
    return {spring.stiffness,    spring.damping,         spring.rest,   spring.speed,  bound(spring.max_force),
            motor.speed,         bound(motor.max_force), axis.friction, axis.armature, bound(limits.lower),
            bound(limits.upper), axis.locked ? 1u : 0u};
}

scree_vehicle_state record_of(const VehicleState& v) {
    return {v.controls.throttle,
            v.controls.brake,
            v.controls.steer,
            v.controls.hand_brake,
            v.speed,
            v.curvature,
            static_cast<std::int32_t>(v.passed),
            static_cast<std::int32_t>(v.next),
            v.by_route ? 1u : 0u,
            v.arrived ? 1u : 0u};
}

}  // namespace

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

scree_result scree_world_joints(scree_world* world, scree_array* states) {
    return called([&] {
        given(states, "states");
        const UsedWorld used(world);
        const std::vector<JointState> all = used->world.joints();
        const std::vector<Joint>& joints = used->world.scene().joints;
        std::vector<scree_joint_state> made;
        made.reserve(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) made.push_back(record_of(all[i], joints[i]));
        *states = kept_array(std::move(made));
    });
}

scree_result scree_world_drives(scree_world* world, int axis, scree_array* drives) {
    return called([&] {
        given(drives, "drives");
        const UsedWorld used(world);
        require_axis(axis);
        std::vector<scree_drive> made;
        for (std::size_t i = 0; i < used->world.scene().joints.size(); ++i)
            made.push_back(record_of(used->world.joint_axis(i, axis_of(used->world, i, axis))));
        *drives = kept_array(std::move(made));
    });
}

scree_result scree_world_set_drives(scree_world* world, const int64_t* joints, size_t count, int axis,
                                    const scree_column* columns, size_t column_count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> named = joints_of(used->world, joints, count);
        require_axis(axis);
        const Columns given(columns, column_count, count,
                            {{"stiffness", 1}, {"damping", 1}, {"target", 1}, {"target_speed", 1}, {"max_force", 1}});
        const Rows stiffness = given["stiffness"], damping = given["damping"], target = given["target"],
                   target_speed = given["target_speed"], max_force = given["max_force"];
        std::vector<JointDrive> drives(count);
        for (std::size_t i = 0; i < count; ++i) {
            drives[i] = {named[i],
                         axis_of(used->world, named[i], axis),
                         stiffness.maybe<float>(i),
                         damping.maybe<float>(i),
                         target.maybe<float>(i),
                         target_speed.maybe<float>(i),
                         {}};
            if (max_force) drives[i].max_force = bounded(max_force.at<float>(i));
        }
        used->world.set_drives(drives);
    });
}

scree_result scree_world_set_motors(scree_world* world, const int64_t* joints, size_t count, int axis,
                                    const scree_column* columns, size_t column_count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> named = joints_of(used->world, joints, count);
        require_axis(axis);
        const Columns given(columns, column_count, count, {{"speed", 1}, {"max_force", 1}});
        const Rows speed = given.required("speed"), max_force = given.required("max_force");
        std::vector<JointMotor> motors(count);
        for (std::size_t i = 0; i < count; ++i)
            motors[i] = {named[i], axis_of(used->world, named[i], axis), {speed.at<float>(i), bounded(max_force.at<float>(i))}};
        used->world.set_motors(motors);
    });
}

scree_result scree_world_set_springs(scree_world* world, const int64_t* joints, size_t count, int axis, const char* spring_json) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> named = joints_of(used->world, joints, count);
        require_axis(axis);
        const Spring spring = value_from<Spring>(json_given(spring_json, "spring_json"), "spring");
        std::vector<JointSpring> springs;
        for (const std::size_t joint : named) springs.push_back({joint, axis_of(used->world, joint, axis), spring});
        used->world.set_springs(springs);
    });
}

scree_result scree_world_set_joint_coordinates(scree_world* world, const int64_t* joints, size_t count, int axis,
                                               const scree_column* columns, size_t column_count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> named = joints_of(used->world, joints, count);
        require_axis(axis);
        const Columns given(columns, column_count, count, {{"coordinate", 1}, {"rate", 1}});
        const Rows coordinate = given["coordinate"], rate = given["rate"];
        std::vector<JointCoordinate> all(count);
        for (std::size_t i = 0; i < count; ++i)
            all[i] = {named[i], axis_of(used->world, named[i], axis), coordinate.maybe<float>(i), rate.maybe<float>(i)};
        used->world.set_joint_coordinates(all);
    });
}

scree_result scree_world_apply_joint_forces(scree_world* world, const int64_t* joints, size_t count, int axis,
                                            const scree_column* columns, size_t column_count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> named = joints_of(used->world, joints, count);
        require_axis(axis);
        const Columns given(columns, column_count, count, {{"force", 1}});
        const Rows force = given.required("force");
        std::vector<JointForce> forces(count);
        for (std::size_t i = 0; i < count; ++i) forces[i] = {named[i], axis_of(used->world, named[i], axis), force.at<float>(i)};
        used->world.apply_joint_forces(forces);
    });
}

scree_result scree_world_add_joint(scree_world* world, const char* joint_json, const float anchor[3], const float axis[3],
                                   size_t* index) {
    return called([&] {
        const UsedWorld used(world);
        Joint joint = value_from<Joint>(json_given(joint_json, "joint_json"), "joint");
        if (anchor != nullptr || axis != nullptr) {
            const Joint placed =
                used->world.joint_at(joint.kind, joint.a, joint.b, three_of(anchor, "anchor"), three_of(axis, "axis"));
            joint.anchor_a = placed.anchor_a;
            joint.anchor_b = placed.anchor_b;
            joint.frame_a = placed.frame_a;
            joint.frame_b = placed.frame_b;
        }
        const std::size_t made = used->world.add_joint(joint);
        if (index != nullptr) *index = made;
    });
}

scree_result scree_world_remove_joint(scree_world* world, size_t joint) {
    return called([&] { UsedWorld(world)->world.remove_joint(joint); });
}

scree_result scree_world_vehicles(scree_world* world, scree_array* states) {
    return called([&] {
        given(states, "states");
        const UsedWorld used(world);
        std::vector<scree_vehicle_state> made;
        for (const VehicleState& state : used->world.vehicles()) made.push_back(record_of(state));
        *states = kept_array(std::move(made));
    });
}

scree_result scree_world_drive(scree_world* world, size_t vehicle, float throttle, float brake, float steer, float hand_brake) {
    return called([&] { UsedWorld(world)->world.drive(vehicle, {throttle, brake, steer, hand_brake}); });
}

scree_result scree_world_drive_by_route(scree_world* world, size_t vehicle) {
    return called([&] { UsedWorld(world)->world.drive_by_route(vehicle); });
}

scree_result scree_world_reset_upright(scree_world* world, size_t vehicle) {
    return called([&] { UsedWorld(world)->world.reset_upright(vehicle); });
}
