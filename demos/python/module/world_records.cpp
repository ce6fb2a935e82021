// Worlds: contacts, events, joints and vehicles as structured arrays.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "demos/python/module/world_object.h"

namespace scree::python {

namespace {

struct ContactRecord {
    std::int64_t a, b;
    std::int32_t part_a, part_b;
    float normal[3], friction[3];
    std::int32_t count;
    float position[4][3], separation[4], force[4];
};
struct EventRecord {
    std::int64_t step;
    std::uint8_t kind;
    std::int64_t a, a_generation, b, b_generation;
    std::int32_t part_a, part_b, joint;
    float speed, impulse, point[3], normal[3];
};
struct SensedRecord {
    std::int64_t sensor, body;
    std::int32_t sensor_part, part;
};
struct JointRecord {
    float force[3], torque[3], max_force, max_torque;
    bool broken;
    float gap, coordinates[6], rates[6];
};
struct DriveRecord {
    float stiffness, damping, target, target_speed, max_force, motor_speed, motor_force, friction, armature, lower, upper;
    bool locked;
};
struct VehicleRecord {
    float throttle, brake, steer, hand_brake, speed, curvature;
    bool by_route;
    std::int32_t passed, next;
    bool arrived;
};

void put(float (&to)[3], vec3 v) {
    for (glm::length_t k = 0; k < 3; ++k) to[k] = v[k];
}

ContactRecord record_of(const ContactState& c) {
    ContactRecord r{};
    r.a = static_cast<std::int64_t>(c.a);
    r.b = static_cast<std::int64_t>(c.b);
    r.part_a = static_cast<std::int32_t>(c.part_a);
    r.part_b = static_cast<std::int32_t>(c.part_b);
    put(r.normal, c.normal);
    put(r.friction, c.friction);
    r.count = static_cast<std::int32_t>(c.count);
    for (std::size_t k = 0; k < c.count; ++k) {
        put(r.position[k], c.points[k].position);
        r.separation[k] = c.points[k].separation;
        r.force[k] = c.points[k].force;
    }
    return r;
}

// Of the world in place of a body -1.
std::int64_t index_or_world(std::uint32_t body) {
    return body == 0xFFFFFFFF ? -1 : static_cast<std::int64_t>(body);
}

EventRecord record_of(const Event& e) {
    EventRecord r{};
    r.step = static_cast<std::int64_t>(e.step);
    r.kind = static_cast<std::uint8_t>(e.kind);
    r.a = index_or_world(e.a);
    r.a_generation = e.a_generation;
    r.b = index_or_world(e.b);
    r.b_generation = e.b_generation;
    r.part_a = static_cast<std::int32_t>(e.part_a);
    r.part_b = static_cast<std::int32_t>(e.part_b);
    r.joint = static_cast<std::int32_t>(e.joint);
    r.speed = e.speed;
    r.impulse = e.impulse;
    put(r.point, e.point);
    put(r.normal, e.normal);
    return r;
}

SensedRecord record_of(const SensorOverlap& o) {
    return {o.sensor, o.body, static_cast<std::int32_t>(o.sensor_part), static_cast<std::int32_t>(o.part)};
}

JointRecord record_of(const JointState& j) {
    JointRecord r{};
    put(r.force, j.force);
    put(r.torque, j.torque);
    r.max_force = j.max_force;
    r.max_torque = j.max_torque;
    r.broken = j.broken;
    r.gap = j.gap;
    std::copy(j.coordinates.begin(), j.coordinates.end(), r.coordinates);
    std::copy(j.rates.begin(), j.rates.end(), r.rates);
    return r;
}

DriveRecord record_of(const Axis& axis) {
    const Spring spring = axis.spring.value_or(Spring{});
    const Motor motor = axis.motor.value_or(Motor{});
    const Limits limits = axis.limits.value_or(Limits{-unlimited, unlimited});
    const auto bound = [](float value) {
        return std::abs(value) >= unlimited ? std::copysign(std::numeric_limits<float>::infinity(), value) : value;
    };
    return {spring.stiffness,       spring.damping, spring.rest,   spring.speed,        bound(spring.max_force), motor.speed,
            bound(motor.max_force), axis.friction,  axis.armature, bound(limits.lower), bound(limits.upper),     axis.locked};
}

// Along or about the axis on which each joint moves: coordinates and rates.
py::tuple joint_motions(WorldObject& object) {
    Use world(object);
    const std::vector<JointState> states = world->joints();
    const std::vector<Joint>& joints = world->scene().joints;
    Floats coordinates(static_cast<py::ssize_t>(states.size())), rates(static_cast<py::ssize_t>(states.size()));
    for (std::size_t i = 0; i < states.size(); ++i) {
        const auto axis = static_cast<std::size_t>(main_axis(joints[i].kind));
        coordinates.mutable_data()[i] = states[i].coordinates[axis];
        rates.mutable_data()[i] = states[i].rates[axis];
    }
    return py::make_tuple(coordinates, rates);
}

// Of the axis of that number, or below 0 of that along or about which each joint moves.
py::array drives(WorldObject& object, int axis) {
    Use world(object);
    std::vector<Axis> axes;
    const std::vector<Joint>& joints = world->scene().joints;
    for (std::size_t i = 0; i < joints.size(); ++i)
        axes.push_back(world->joint_axis(i, axis < 0 ? main_axis(joints[i].kind) : static_cast<JointAxis>(axis)));
    return records_of(axes, [](const Axis& one) { return record_of(one); });
}

// Of one copy.
std::vector<std::string> names(WorldObject& object, const std::string& list) {
    Use world(object);
    const auto of = [&](const auto& things) { return all_names(things, things.size() / world->copies()); };
    return list == "bodies" ? of(world->scene().bodies) : of(world->scene().joints);
}
std::vector<std::size_t> indices_by_name(WorldObject& object, const std::string& list, const std::string& name) {
    Use world(object);
    const auto of = [&](const auto& things) { return first_named(things, things.size() / world->copies(), name); };
    return list == "bodies" ? of(world->scene().bodies) : of(world->scene().joints);
}

VehicleRecord record_of(const VehicleState& v) {
    return {v.controls.throttle,
            v.controls.brake,
            v.controls.steer,
            v.controls.hand_brake,
            v.speed,
            v.curvature,
            v.by_route,
            static_cast<std::int32_t>(v.passed),
            static_cast<std::int32_t>(v.next),
            v.arrived};
}

template <class State>
py::array state_records(const std::vector<State>& states) {
    return records_of(states, [](const State& state) { return record_of(state); });
}

}  // namespace

void bind_records(py::module_& module, WorldClass& of_world) {
    PYBIND11_NUMPY_DTYPE(ContactRecord, a, b, part_a, part_b, normal, friction, count, position, separation, force);
    PYBIND11_NUMPY_DTYPE(EventRecord, step, kind, a, a_generation, b, b_generation, part_a, part_b, joint, speed, impulse, point,
                         normal);
    PYBIND11_NUMPY_DTYPE(SensedRecord, sensor, body, sensor_part, part);
    PYBIND11_NUMPY_DTYPE(JointRecord, force, torque, max_force, max_torque, broken, gap, coordinates, rates);
    PYBIND11_NUMPY_DTYPE(DriveRecord, stiffness, damping, target, target_speed, max_force, motor_speed, motor_force, friction,
                         armature, lower, upper, locked);
    PYBIND11_NUMPY_DTYPE(VehicleRecord, throttle, brake, steer, hand_brake, speed, curvature, by_route, passed, next, arrived);
    module.attr("contact_dtype") = py::dtype::of<ContactRecord>();
    module.attr("event_dtype") = py::dtype::of<EventRecord>();
    module.attr("joint_dtype") = py::dtype::of<JointRecord>();
    module.attr("drive_dtype") = py::dtype::of<DriveRecord>();
    module.attr("vehicle_dtype") = py::dtype::of<VehicleRecord>();
    of_world.def("contacts", [](WorldObject& object) { return state_records(Use(object)->contacts()); })
        .def("joints", [](WorldObject& object) { return state_records(Use(object)->joints()); })
        .def("joint_motions", &joint_motions)
        .def("drives", &drives)
        .def("names", &names)
        .def("indices_of", &indices_by_name)
        .def("joint_count", [](WorldObject& object) { return Use(object)->scene().joints.size(); })
        .def("vehicles", [](WorldObject& object) { return state_records(Use(object)->vehicles()); })
        .def("take_events", [](WorldObject& object) { return state_records(Use(object)->take_events()); })
        .def("records_events", [](WorldObject& object) { return Use(object)->event_settings().any(); })
        .def("set_events",
             [](WorldObject& object, bool contacts, float hit_speed, bool breaks, bool sleep, bool sensors) {
                 Use(object)->set_events({contacts, hit_speed, breaks, sleep, sensors});
             })
        .def("sensed", [](WorldObject& object) { return state_records(Use(object)->sensed()); });
}

}  // namespace scree::python
