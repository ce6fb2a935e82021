// Where the members of the C interface's structs lie, for JavaScript.
#include <cstddef>
#include <string>
#include <type_traits>

#include "demos/c/scree.h"

namespace {

template <class Member>
std::string kind() {
    using Value = std::remove_all_extents_t<Member>;
    constexpr bool is_number = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;
    const std::string letter = std::is_floating_point_v<Value> ? "f" : std::is_signed_v<Value> && is_number ? "i" : "u";
    return letter + std::to_string(8 * sizeof(Value));
}

template <class Member>
std::string member(const char* name, std::size_t offset) {
    return std::string("\"") + name + "\":[" + std::to_string(offset) + ",\"" + kind<Member>() + "\"," +
           std::to_string(std::is_array_v<Member> ? sizeof(Member) / sizeof(std::remove_all_extents_t<Member>) : 0) + "]";
}

struct Layouts {
    std::string text = "{";
    template <class Struct>
    void add(const char* name, const std::string& members) {
        if (text.size() > 1) text += ',';
        text += std::string("\"") + name + "\":{\"size\":" + std::to_string(sizeof(Struct)) + ",\"members\":{" +
                members.substr(0, members.size() - 1) + "}}";
    }
};

}  // namespace

#define M(name) +member<decltype(Struct::name)>(#name, offsetof(Struct, name)) + ","
#define LAYOUT(name, members)                              \
    {                                                      \
        using Struct = name;                               \
        layouts.add<Struct>(#name, std::string() members); \
    }

extern "C" const char* scree_js_layouts() {
    static const std::string text = [] {
        Layouts layouts;
        LAYOUT(scree_column, M(name) M(data) M(stride))
        LAYOUT(scree_output, M(name) M(data) M(stride))
        LAYOUT(scree_array, M(data) M(count) M(stride))
        LAYOUT(scree_load_options, M(size) M(strict) M(file_axes) M(ground) M(allow_outside) M(base) M(keyframe) M(packages_json))
        LAYOUT(scree_world_options, M(size) M(backend) M(settings_json) M(threads) M(copies))
        LAYOUT(scree_world_info,
               M(size) M(steps) M(time) M(bodies) M(bodies_there) M(joints) M(copies) M(buffer_bytes) M(records_events) M(device))
        LAYOUT(scree_statistics,
               M(size) M(bodies) M(broken) M(pieces) M(manifolds) M(points) M(penetration_mean) M(penetration_max)
                   M(penetration_resting) M(max_speed) M(max_spin) M(spin_limited) M(kinetic_energy) M(potential_energy)
                       M(momentum) M(angular_momentum) M(drift_max) M(asleep) M(not_finite) M(below_ground) M(joints)
                           M(joints_broken) M(joint_force_max) M(joint_torque_max))
        LAYOUT(scree_body, M(index) M(generation))
        LAYOUT(scree_grip_options, M(size) M(hertz) M(damping_ratio) M(max_acceleration) M(spin_damping))
        LAYOUT(scree_contact, M(a) M(b) M(part_a) M(part_b) M(normal) M(friction) M(count) M(position) M(separation) M(force))
        LAYOUT(scree_event, M(step) M(a) M(a_generation) M(b) M(b_generation) M(part_a) M(part_b) M(joint) M(kind) M(speed)
                                M(impulse) M(point) M(normal))
        LAYOUT(scree_event_options, M(size) M(contacts) M(hit_speed) M(breaks) M(sleep) M(sensors))
        LAYOUT(scree_sensed, M(sensor) M(body) M(sensor_part) M(part))
        LAYOUT(scree_joint_state, M(force) M(torque) M(max_force) M(max_torque) M(gap) M(coordinates) M(rates) M(broken) M(axis))
        LAYOUT(scree_drive, M(stiffness) M(damping) M(target) M(target_speed) M(max_force) M(motor_speed) M(motor_force)
                                M(friction) M(armature) M(lower) M(upper) M(locked))
        LAYOUT(scree_vehicle_state,
               M(throttle) M(brake) M(steer) M(hand_brake) M(speed) M(curvature) M(passed) M(next) M(by_route) M(arrived))
        LAYOUT(scree_ray, M(from) M(along) M(reach) M(mask) M(solid) M(copy))
        LAYOUT(scree_hit, M(body) M(part) M(distance) M(point) M(normal))
        LAYOUT(scree_part, M(body) M(part))
        LAYOUT(scree_depth, M(body) M(part) M(depth) M(normal))
        LAYOUT(scree_cast, M(from) M(orientation) M(along) M(reach) M(mask) M(solid) M(copy) M(ignored))
        LAYOUT(scree_placed, M(position) M(orientation) M(mask) M(ignored) M(copy))
        LAYOUT(scree_point, M(point) M(reach) M(mask) M(copy))
        LAYOUT(scree_debug_options, M(size) M(shapes) M(contacts) M(joints) M(boxes) M(segments) M(line_length) M(force_length)
                                        M(bodies) M(body_count))
        LAYOUT(scree_record_options, M(size) M(title) M(camera_json) M(look_json) M(fps) M(copy) M(contacts) M(events) M(live))
        LAYOUT(scree_line, M(from) M(to) M(color))
        LAYOUT(scree_dot, M(position) M(color))
        return layouts.text + "}";
    }();
    return text.c_str();
}
