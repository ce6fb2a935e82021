// Worlds: reading and setting bodies in bulk, and the tables of the CPU path as read-only views.
#include <pybind11/eval.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "compute/tables/state.h"
#include "demos/python/module/world_object.h"

namespace scree::python {

namespace {

template <glm::length_t width>
Floats column_of(const std::vector<BodyState>& bodies, glm::vec<width, float> BodyState::*member) {
    Floats made({static_cast<py::ssize_t>(bodies.size()), static_cast<py::ssize_t>(width)});
    float* to = made.mutable_data();
    for (const BodyState& body : bodies)
        for (glm::length_t k = 0; k < width; ++k) *to++ = (body.*member)[k];
    return made;
}

py::array_t<bool> flags_of(const std::vector<BodyState>& bodies, bool BodyState::*member) {
    py::array_t<bool> made(static_cast<py::ssize_t>(bodies.size()));
    bool* to = made.mutable_data();
    for (const BodyState& body : bodies) *to++ = body.*member;
    return made;
}

py::object column_named(const std::vector<BodyState>& bodies, const std::string& name) {
    if (name == "position") return column_of(bodies, &BodyState::position);
    if (name == "orientation") return column_of(bodies, &BodyState::orientation);
    if (name == "velocity") return column_of(bodies, &BodyState::velocity);
    if (name == "angular_velocity") return column_of(bodies, &BodyState::angular_velocity);
    if (name == "asleep") return flags_of(bodies, &BodyState::asleep);
    if (name == "exists") return flags_of(bodies, &BodyState::exists);
    throw py::key_error(name);
}

py::dict columns_of(WorldObject& object, const std::vector<std::string>& names) {
    const std::vector<BodyState> bodies = Use(object)->bodies();
    py::dict made;
    for (const std::string& name : names) made[name.c_str()] = column_named(bodies, name);
    return made;
}

std::vector<std::size_t> indices_of(const Indices& ids, const World& world) {
    const std::size_t bodies = world.scene().bodies.size();
    std::vector<std::size_t> made(static_cast<std::size_t>(ids.size()));
    for (std::size_t i = 0; i < made.size(); ++i) {
        const std::int64_t id = ids.data()[i];
        if (id < 0 || static_cast<std::size_t>(id) >= bodies)
            throw py::index_error("body " + std::to_string(id) + " of " + std::to_string(bodies));
        made[i] = static_cast<std::size_t>(id);
    }
    return made;
}

using MaybeFloats = std::optional<Floats>;

void set(WorldObject& object, const Indices& ids, const MaybeFloats& position, const MaybeFloats& orientation,
         const MaybeFloats& velocity, const MaybeFloats& angular_velocity) {
    Use world(object);
    const std::vector<std::size_t> bodies = indices_of(ids, *world);
    const auto n = static_cast<py::ssize_t>(bodies.size());
    if (position) require_shape(*position, n, 3, "position");
    if (orientation) require_shape(*orientation, n, 4, "orientation");
    if (velocity) require_shape(*velocity, n, 3, "velocity");
    if (angular_velocity) require_shape(*angular_velocity, n, 3, "angular_velocity");
    std::vector<BodyChange> changes(bodies.size());
    for (std::size_t i = 0; i < changes.size(); ++i) {
        changes[i].body = bodies[i];
        if (position) changes[i].position = vec3_at(position->data(), i);
        if (orientation) changes[i].orientation = vec4_at(orientation->data(), i);
        if (velocity) changes[i].velocity = vec3_at(velocity->data(), i);
        if (angular_velocity) changes[i].angular_velocity = vec3_at(angular_velocity->data(), i);
    }
    const py::gil_scoped_release unlocked;
    world->set_bodies(changes);
}

// Checks all before any is applied.
void apply(WorldObject& object, const Indices& ids, const MaybeFloats& force, const MaybeFloats& torque,
           const MaybeFloats& impulse, const MaybeFloats& angular_impulse, const MaybeFloats& offset) {
    Use world(object);
    const std::vector<std::size_t> bodies = indices_of(ids, *world);
    const auto n = static_cast<py::ssize_t>(bodies.size());
    const std::pair<const MaybeFloats*, const char*> given[] = {{&force, "force"},
                                                                {&torque, "torque"},
                                                                {&impulse, "impulse"},
                                                                {&angular_impulse, "angular_impulse"},
                                                                {&offset, "offset"}};
    for (const auto& [values, name] : given) {
        if (!*values) continue;
        require_shape(**values, n, 3, name);
        for (py::ssize_t i = 0; i < (*values)->size(); ++i)
            if (!std::isfinite((*values)->data()[i]))
                throw py::value_error("body " + std::to_string(bodies[static_cast<std::size_t>(i / 3)]) + ": the " + name +
                                      " is not finite");
    }
    for (const std::size_t body : bodies) {
        world->handle_of(body);
        if (world->scene().bodies[body].motion != Motion::dynamic)
            throw py::value_error("body " + std::to_string(body) + " is not dynamic");
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const vec3 at = offset ? vec3_at(offset->data(), i) : vec3(0);
        if (force) world->apply_force(bodies[i], vec3_at(force->data(), i), at);
        if (torque) world->apply_torque(bodies[i], vec3_at(torque->data(), i));
        if (impulse) world->apply_impulse(bodies[i], vec3_at(impulse->data(), i), at);
        if (angular_impulse) world->apply_angular_impulse(bodies[i], vec3_at(angular_impulse->data(), i));
    }
}

Floats touch_forces(WorldObject& object, const Indices& ids) {
    Use world(object);
    const std::vector<vec3> forces = world->touch_forces(indices_of(ids, *world));
    Floats made({static_cast<py::ssize_t>(forces.size()), py::ssize_t{3}});
    for (std::size_t i = 0; i < forces.size(); ++i)
        for (glm::length_t k = 0; k < 3; ++k) made.mutable_data()[3 * i + static_cast<std::size_t>(k)] = forces[i][k];
    return made;
}

// Positions and orientations.
py::tuple origins(WorldObject& object, const Indices& ids) {
    Use world(object);
    const std::vector<BodyFrame> frames = world->origins(indices_of(ids, *world));
    Floats position({static_cast<py::ssize_t>(frames.size()), py::ssize_t{3}});
    Floats orientation({static_cast<py::ssize_t>(frames.size()), py::ssize_t{4}});
    for (std::size_t i = 0; i < frames.size(); ++i) {
        for (glm::length_t k = 0; k < 3; ++k)
            position.mutable_data()[3 * i + static_cast<std::size_t>(k)] = frames[i].position[k];
        for (glm::length_t k = 0; k < 4; ++k)
            orientation.mutable_data()[4 * i + static_cast<std::size_t>(k)] = frames[i].orientation[k];
    }
    return py::make_tuple(position, orientation);
}

Floats masses(WorldObject& object) {
    Use world(object);
    const std::vector<Body>& bodies = world->scene().bodies;
    Floats made(static_cast<py::ssize_t>(bodies.size()));
    std::transform(bodies.begin(), bodies.end(), made.mutable_data(),
                   [](const Body& body) { return mass_properties(body).mass; });
    return made;
}

// ---- views
// Keeps the world, and notes that an array looks into its tables.
struct Token {
    std::shared_ptr<WorldObject> object;
    explicit Token(std::shared_ptr<WorldObject> looked_at) : object(std::move(looked_at)) { ++object->views; }
    ~Token() { --object->views; }
    Token(const Token&) = delete;
    Token& operator=(const Token&) = delete;
};

template <class Record>
py::array view_of(const std::shared_ptr<WorldObject>& object, const py::dtype& type, const std::vector<Record>& table,
                  std::size_t rows) {
    auto* token = new Token(object);
    const py::capsule base(token, [](void* kept) { delete static_cast<Token*>(kept); });
    py::array made(type, {static_cast<py::ssize_t>(std::min(rows, table.size()))}, {static_cast<py::ssize_t>(sizeof(Record))},
                   table.data(), base);
    py::detail::array_proxy(made.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return made;
}

py::dtype record_type(const char* fields, std::size_t bytes) {
    const py::dict names = py::eval(fields);
    py::dict given = names;
    given["itemsize"] = bytes;
    return py::dtype::from_args(given);
}

py::array table(const std::shared_ptr<WorldObject>& object, const std::string& name) {
    Use world(*object);
    if (world->runner().backend() != "cpu")
        throw py::buffer_error("the tables of this world are on " + world->runner().device() +
                               "; World.position and the like copy them, and backend=\"cpu\" keeps them here");
    const State& state = world->state();
    const std::size_t rows = state.fixed().bodies;
    static_assert(sizeof(physics::Pose) == 32 && sizeof(physics::Velocity) == 32);
    if (name == "poses")
        return view_of(object,
                       record_type("{'names': ['position', 'orientation'], 'formats': ['(3,)f4', '(4,)f4'], 'offsets': [0, 16]}",
                                   sizeof(physics::Pose)),
                       state.poses, rows);
    if (name == "velocities")
        return view_of(object,
                       record_type("{'names': ['linear', 'angular'], 'formats': ['(3,)f4', '(3,)f4'], 'offsets': [0, 16]}",
                                   sizeof(physics::Velocity)),
                       state.velocities, rows);
    if (name == "ids") return view_of(object, py::dtype::of<std::uint32_t>(), state.ids, rows);
    throw py::key_error(name);
}

}  // namespace

void bind_state(WorldClass& of_world) {
    of_world.def("columns", &columns_of)
        .def("count", [](WorldObject& object) { return Use(object)->scene().bodies.size(); })
        .def("bodies_there", [](WorldObject& object) { return Use(object)->bodies_there(); })
        .def("set", &set)
        .def("apply", &apply)
        .def("touch_forces", &touch_forces)
        .def("origins", &origins)
        .def("masses", &masses)
        .def("row_of", [](WorldObject& object, std::size_t body) { return Use(object)->row_of(body); });
}

void bind_tables(WorldClass& of_world) {
    of_world.def("table", [](const std::shared_ptr<WorldObject>& object, const std::string& name) { return table(object, name); })
        .def_property_readonly("views", [](WorldObject& object) { return object.views; });
}

}  // namespace scree::python
