// Worlds: bodies that come and go, their materials and joints, and what acts on them.
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "compute/scene_file/document_fields.h"
#include "compute/scene_file/fields_read.h"
#include "demos/python/module/world_object.h"

namespace scree::python {

namespace {

using namespace json_reading;

template <class Value>
Value value_of(const std::string& text, const char* name) {
    Value made{};
    read_value(json_of(text), root / name, made, "", {});
    return made;
}

vec3 vec3_of(const Floats& values, const char* name) {
    if (values.size() != 3) throw py::value_error(std::string(name) + ": is three numbers");
    return vec3_at(values.data(), 0);
}

// Bodies of a description, added to a world that runs: index and generation of each.
Indices add(WorldObject& object, const Description& scene) {
    object.require_no_views("added to");
    Use world(object);
    std::vector<BodyHandle> handles;
    {
        const py::gil_scoped_release unlocked;
        handles = world->add_bodies(scene.document.scene.bodies);
    }
    Indices made({static_cast<py::ssize_t>(handles.size()), py::ssize_t{2}});
    for (std::size_t i = 0; i < handles.size(); ++i) {
        made.mutable_data()[2 * i] = handles[i].index;
        made.mutable_data()[2 * i + 1] = handles[i].generation;
    }
    return made;
}

BodyHandle handle_at(const Indices& handles, std::size_t i) {
    const std::int64_t index = handles.data()[2 * i], generation = handles.data()[2 * i + 1];
    if (index < 0 || index > 0xFFFFFFFF || generation < 0 || generation > 0xFFFFFFFF)
        throw py::index_error("body " + std::to_string(index) + ": no handle of a body");
    return {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(generation)};
}

// `handles`: (n, 2), index and generation
void remove(WorldObject& object, const Indices& handles) {
    object.require_no_views("taken from");
    Use world(object);
    require_shape(handles, handles.ndim() > 0 ? handles.shape(0) : 0, 2, "handles");
    std::vector<BodyHandle> named;
    for (std::size_t i = 0; i < static_cast<std::size_t>(handles.shape(0)); ++i) named.push_back(handle_at(handles, i));
    const py::gil_scoped_release unlocked;
    world->remove_bodies(named);
}

Indices handles(WorldObject& object, const Indices& ids) {
    Use world(object);
    Indices made({ids.size(), py::ssize_t{2}});
    for (py::ssize_t i = 0; i < ids.size(); ++i) {
        const std::int64_t id = ids.data()[i];
        if (id < 0) throw py::index_error("body " + std::to_string(id));
        const BodyHandle handle = world->handle_of(static_cast<std::size_t>(id));
        made.mutable_data()[2 * i] = handle.index;
        made.mutable_data()[2 * i + 1] = handle.generation;
    }
    return made;
}

py::array_t<bool> are_valid(WorldObject& object, const Indices& handles) {
    Use world(object);
    require_shape(handles, handles.ndim() > 0 ? handles.shape(0) : 0, 2, "handles");
    py::array_t<bool> made(handles.shape(0));
    for (std::size_t i = 0; i < static_cast<std::size_t>(handles.shape(0)); ++i)
        made.mutable_data()[i] = world->is_valid(handle_at(handles, i));
    return made;
}

std::size_t add_joint_to_world(WorldObject& object, const std::string& text, const std::optional<Floats>& anchor,
                               const Floats& axis) {
    Use world(object);
    Joint joint = value_of<Joint>(text, "joint");
    if (anchor) {
        const Joint placed = world->joint_at(joint.kind, joint.a, joint.b, vec3_of(*anchor, "anchor"), vec3_of(axis, "axis"));
        joint.anchor_a = placed.anchor_a;
        joint.anchor_b = placed.anchor_b;
        joint.frame_a = placed.frame_a;
        joint.frame_b = placed.frame_b;
    }
    return world->add_joint(joint);
}

JointAxis axis_named(const std::string& name) {
    const Names words = {"x", "y", "z", "twist", "swing_y", "swing_z"};
    const auto found = std::find(words.begin(), words.end(), name);
    if (found == words.end()) throw py::value_error(unknown("axis", name, words));
    return static_cast<JointAxis>(found - words.begin());
}

// Without a name that of each joint which it moves along or about.
JointAxis axis_named(const std::string& name, const World& world, std::size_t joint) {
    return name.empty() ? main_axis(world.scene().joints.at(joint).kind) : axis_named(name);
}

std::vector<std::size_t> joints_of(const Indices& joints, const World& world) {
    const std::size_t count = world.scene().joints.size();
    std::vector<std::size_t> made;
    for (py::ssize_t i = 0; i < joints.size(); ++i) {
        const std::int64_t joint = joints.data()[i];
        if (joint < 0 || static_cast<std::size_t>(joint) >= count)
            throw py::index_error("joint " + std::to_string(joint) + " of " + std::to_string(count));
        made.push_back(static_cast<std::size_t>(joint));
    }
    return made;
}

using MaybeFloats = std::optional<Floats>;

std::optional<float> value_at(const MaybeFloats& values, std::size_t i) {
    if (!values) return std::nullopt;
    return values->data()[i];
}
float force_at(const Floats& values, std::size_t i) {
    return values.data()[i] == std::numeric_limits<float>::infinity() ? unlimited : values.data()[i];
}

void set_motors(WorldObject& object, const Indices& joints, const std::string& axis, const Floats& speed,
                const Floats& max_force) {
    Use world(object);
    const std::vector<std::size_t> named = joints_of(joints, *world);
    require_shape(speed, joints.size(), 0, "speed");
    require_shape(max_force, joints.size(), 0, "max_force");
    for (std::size_t i = 0; i < named.size(); ++i)
        world->set_motor(named[i], axis_named(axis, *world, named[i]), {speed.data()[i], force_at(max_force, i)});
}

void set_springs(WorldObject& object, const Indices& joints, const std::string& axis, const std::string& spring) {
    Use world(object);
    const Spring made = value_of<Spring>(spring, "spring");
    for (const std::size_t joint : joints_of(joints, *world)) world->set_spring(joint, axis_named(axis, *world, joint), made);
}

void set_drives(WorldObject& object, const Indices& joints, const std::string& axis, const MaybeFloats& stiffness,
                const MaybeFloats& damping, const MaybeFloats& target, const MaybeFloats& target_speed,
                const MaybeFloats& max_force) {
    Use world(object);
    const std::vector<std::size_t> named = joints_of(joints, *world);
    const std::pair<const MaybeFloats*, const char*> given[] = {{&stiffness, "stiffness"},
                                                                {&damping, "damping"},
                                                                {&target, "target"},
                                                                {&target_speed, "target_speed"},
                                                                {&max_force, "max_force"}};
    for (const auto& [values, name] : given)
        if (*values) require_shape(**values, joints.size(), 0, name);
    std::vector<JointDrive> drives(named.size());
    for (std::size_t i = 0; i < drives.size(); ++i) {
        drives[i].joint = named[i];
        drives[i].axis = axis_named(axis, *world, named[i]);
        drives[i].stiffness = value_at(stiffness, i);
        drives[i].damping = value_at(damping, i);
        drives[i].target = value_at(target, i);
        drives[i].target_speed = value_at(target_speed, i);
        if (max_force) drives[i].max_force = force_at(*max_force, i);
    }
    world->set_drives(drives);
}

void set_joint_coordinates(WorldObject& object, const Indices& joints, const std::string& axis, const MaybeFloats& coordinate,
                           const MaybeFloats& rate) {
    Use world(object);
    const std::vector<std::size_t> named = joints_of(joints, *world);
    if (coordinate) require_shape(*coordinate, joints.size(), 0, "coordinate");
    if (rate) require_shape(*rate, joints.size(), 0, "rate");
    std::vector<JointCoordinate> all(named.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = {named[i], axis_named(axis, *world, named[i]), value_at(coordinate, i), value_at(rate, i)};
    const py::gil_scoped_release unlocked;
    world->set_joint_coordinates(all);
}

void apply_joint_forces(WorldObject& object, const Indices& joints, const std::string& axis, const Floats& force) {
    Use world(object);
    const std::vector<std::size_t> named = joints_of(joints, *world);
    require_shape(force, joints.size(), 0, "force");
    std::vector<JointForce> forces(named.size());
    for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = {named[i], axis_named(axis, *world, named[i]), force.data()[i]};
    world->apply_joint_forces(forces);
}

Motion motion_named(const std::string& name) {
    const Names words(schema::words<Motion>.begin(), schema::words<Motion>.end());
    const auto found = std::find(words.begin(), words.end(), name);
    if (found == words.end()) throw py::value_error(unknown("motion", name, words));
    return static_cast<Motion>(found - words.begin());
}

// Of each the material that it has but for the given fields.
void set_material(WorldObject& object, const Indices& ids, const std::string& text) {
    Use world(object);
    const json given = json_of(text);
    const Place place = root / "material";
    for (py::ssize_t i = 0; i < ids.size(); ++i) {
        const auto body = static_cast<std::size_t>(ids.data()[i]);
        world->handle_of(body);
        Material material = material_of(world->scene().bodies[body]);
        only(given, place, keys_of<Material>());
        read_fields(given, place, material);
        world->set_material(body, material);
    }
}

void move_bodies(WorldObject& object, const Indices& ids, const Floats& position, const Floats& orientation, int steps) {
    Use world(object);
    require_shape(position, ids.size(), 3, "position");
    require_shape(orientation, ids.size(), 4, "orientation");
    std::vector<BodyTarget> targets(static_cast<std::size_t>(ids.size()));
    for (std::size_t i = 0; i < targets.size(); ++i)
        targets[i] = {static_cast<std::size_t>(ids.data()[i]), vec3_at(position.data(), i), vec4_at(orientation.data(), i),
                      steps};
    world->move_bodies(targets);
}

void tune(WorldObject& object, const std::string& what, double value) {
    Use world(object);
    if (what == "friction_factor") return world->set_friction_factor(static_cast<float>(value));
    if (what == "least_restitution") return world->set_least_restitution(static_cast<float>(value));
    if (what == "substeps") return world->set_substeps(static_cast<int>(value));
    if (what == "sleeping") return world->set_sleeping(value != 0);
    throw py::key_error(what);
}

void bind_bodies(WorldClass& of_world) {
    of_world.def("add", &add)
        .def("remove", &remove)
        .def("handles", &handles)
        .def("are_valid", &are_valid)
        .def("wake",
             [](WorldObject& object, const Indices& ids) {
                 Use world(object);
                 for (py::ssize_t i = 0; i < ids.size(); ++i) world->wake(static_cast<std::size_t>(ids.data()[i]));
             })
        .def("wake_all", [](WorldObject& object) { Use(object)->wake_all(); })
        .def("set_material", &set_material)
        .def("set_mass", [](WorldObject& object, std::size_t body, float mass) { Use(object)->set_mass(body, mass); })
        .def("move", &move_bodies)
        .def("set_fields",
             [](WorldObject& object, const std::string& text) { Use(object)->set_fields(value_of<Fields>(text, "fields")); })
        .def("set_filter", [](WorldObject& object, std::size_t body,
                              const std::string& filter) { Use(object)->set_filter(body, value_of<Filter>(filter, "filter")); })
        .def("set_motion", [](WorldObject& object, std::size_t body,
                              const std::string& motion) { Use(object)->set_motion(body, motion_named(motion)); })
        .def("set_exclusion",
             [](WorldObject& object, std::size_t a, std::size_t b, bool excluded) { Use(object)->set_exclusion(a, b, excluded); })
        .def("tune", &tune)
        .def_property(
            "gravity",
            [](WorldObject& object) {
                const vec3 g = Use(object)->scene().gravity;
                return py::make_tuple(g.x, g.y, g.z);
            },
            [](WorldObject& object, const Floats& gravity) { Use(object)->set_gravity(vec3_of(gravity, "gravity")); });
}

void bind_joints(WorldClass& of_world) {
    of_world.def("add_joint", &add_joint_to_world)
        .def("remove_joint", [](WorldObject& object, std::size_t joint) { Use(object)->remove_joint(joint); })
        .def("set_motors", &set_motors)
        .def("set_springs", &set_springs)
        .def("set_drives", &set_drives)
        .def("set_joint_coordinates", &set_joint_coordinates)
        .def("apply_joint_forces", &apply_joint_forces)
        .def("drive",
             [](WorldObject& object, std::size_t vehicle, float throttle, float brake, float steer, float hand_brake) {
                 Use(object)->drive(vehicle, {throttle, brake, steer, hand_brake});
             })
        .def("drive_by_route", [](WorldObject& object, std::size_t vehicle) { Use(object)->drive_by_route(vehicle); })
        .def("reset_upright", [](WorldObject& object, std::size_t vehicle) { Use(object)->reset_upright(vehicle); });
}

}  // namespace

void bind_changes(WorldClass& of_world) {
    bind_bodies(of_world);
    bind_joints(of_world);
    of_world
        .def("grip",
             [](WorldObject& object, std::size_t body, const Floats& anchor, const Floats& target, float hertz,
                float damping_ratio, float max_acceleration, float spin_damping) {
                 return Use(object)->grip(body, vec3_of(anchor, "anchor"), vec3_of(target, "target"),
                                          {hertz, damping_ratio, max_acceleration, spin_damping});
             })
        .def("move_grip", [](WorldObject& object, std::size_t grip,
                             const Floats& target) { Use(object)->move_grip(grip, vec3_of(target, "target")); })
        .def("release", [](WorldObject& object, std::size_t grip) { Use(object)->release(grip); })
        .def("explode", [](WorldObject& object, const Floats& centre, float radius, float speed) {
            Use(object)->explode(vec3_of(centre, "centre"), radius, speed);
        });
}

}  // namespace scree::python
