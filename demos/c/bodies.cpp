// The C interface: bodies of a world that are read, set, pushed, added and removed, and views of the tables.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>

#include "compute/tables/state.h"
#include "demos/c/json.h"
#include "demos/c/objects.h"

namespace scree::c {

using namespace json_reading;

namespace {

std::vector<std::size_t> bodies_of(const World& world, const std::int64_t* bodies, std::size_t count) {
    return indices_of(bodies, count, world.scene().bodies.size(), "body");
}

// ---- Rows of the caller's memory that are written
struct Writer {
    const char* name;
    std::size_t bytes;  // of a row
    std::function<void(char* to, std::size_t stride)> write;
};

// Of a value of each row.
template <class Of>
Writer writer(const char* name, std::size_t rows, Of of) {
    using Value = decltype(of(std::size_t{0}));
    return {name, sizeof(Value), [rows, of](char* to, std::size_t stride) {
                for (std::size_t row = 0; row < rows; ++row) {
                    const Value value = of(row);
                    std::memcpy(to + row * stride, &value, sizeof value);
                }
            }};
}

void write_outputs(const scree_output* outputs, std::size_t output_count, std::size_t rows, const std::vector<Writer>& writers) {
    given_array(outputs, output_count, "outputs");
    std::vector<std::pair<const Writer*, std::size_t>> wanted;  // with strides
    for (std::size_t i = 0; i < output_count; ++i) {
        const std::string name = text_of(outputs[i].name, "the name of an output");
        const auto at = std::find_if(writers.begin(), writers.end(), [&](const Writer& one) { return one.name == name; });
        if (at == writers.end()) {
            Names names;
            for (const Writer& one : writers) names.emplace_back(one.name);
            refuse(unknown("output", name, names));
        }
        const Writer& one = *at;
        given_array(outputs[i].data, rows, one.name);
        wanted.emplace_back(&one, outputs[i].stride == 0 ? one.bytes : stride_of(outputs[i].stride, one.bytes, one.name));
    }
    for (std::size_t i = 0; i < output_count; ++i) wanted[i].first->write(static_cast<char*>(outputs[i].data), wanted[i].second);
}

// ---- Handles of bodies
BodyHandle body_of_handle(const scree_body& body) {
    return {body.index, body.generation};
}

std::vector<BodyHandle> body_handles(const scree_body* bodies, std::size_t count) {
    given_array(bodies, count, "bodies");
    std::vector<BodyHandle> made(count);
    std::transform(bodies, bodies + count, made.begin(), body_of_handle);
    return made;
}

// Checks all before any is applied.
void apply(World& world, const std::vector<std::size_t>& bodies, const Columns& given) {
    const Rows force = given["force"], torque = given["torque"], impulse = given["impulse"], turn = given["angular_impulse"],
               offset = given["offset"];
    const std::pair<const Rows&, const char*> all[] = {
        {force, "force"}, {torque, "torque"}, {impulse, "impulse"}, {turn, "angular_impulse"}, {offset, "offset"}};
    for (const auto& [rows, name] : all)
        for (std::size_t i = 0; rows && i < bodies.size(); ++i) {
            const vec3 value = rows.at<vec3>(i);
            if (!(std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z)))
                refuse("body " + std::to_string(bodies[i]) + ": the " + name + " is not finite");
        }
    for (const std::size_t body : bodies) {
        world.handle_of(body);
        if (world.scene().bodies[body].motion != Motion::dynamic) refuse("body " + std::to_string(body) + " is not dynamic");
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const vec3 at = offset ? offset.at<vec3>(i) : vec3(0);
        if (force) world.apply_force(bodies[i], force.at<vec3>(i), at);
        if (torque) world.apply_torque(bodies[i], torque.at<vec3>(i));
        if (impulse) world.apply_impulse(bodies[i], impulse.at<vec3>(i), at);
        if (turn) world.apply_angular_impulse(bodies[i], turn.at<vec3>(i));
    }
}

void set_of_world(World& world, const std::string& what, const json& value) {
    const Place place = root / what.c_str();
    float number = 0;
    const auto read_number = [&] { return read(value, place, number), number; };
    if (what == "fields") return world.set_fields(value_from<Fields>(value, "fields"));
    if (what == "friction_factor") return world.set_friction_factor(read_number());
    if (what == "least_restitution") return world.set_least_restitution(read_number());
    if (what == "substeps") {
        std::int32_t substeps = 0;
        read(value, place, substeps);
        return world.set_substeps(substeps);
    }
    if (what == "cell_rate") {
        vec3 rate;
        read(value, place, rate);
        return world.set_cell_rate(rate);
    }
    bool on = false;
    if (what == "sleeping") return read(value, place, on), world.set_sleeping(on);
    if (what == "profiling") return read(value, place, on), world.set_profiling(on);
    refuse(unknown("what", what,
                   {"fields", "friction_factor", "least_restitution", "substeps", "cell_rate", "sleeping", "profiling"}));
}

}  // namespace

}  // namespace scree::c

using namespace scree;
using namespace scree::c;

scree_result scree_world_read(scree_world* world, const scree_output* outputs, size_t output_count, size_t count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<BodyState> bodies = used->world.bodies();
        if (count < bodies.size())
            refuse("count: the memory has " + std::to_string(count) + " rows, and the world " + std::to_string(bodies.size()) +
                   " bodies");
        const std::vector<Body>& described = used->world.scene().bodies;
        const std::size_t n = bodies.size();
        write_outputs(outputs, output_count, n,
                      {writer("position", n, [&](std::size_t i) { return bodies[i].position; }),
                       writer("orientation", n, [&](std::size_t i) { return bodies[i].orientation; }),
                       writer("velocity", n, [&](std::size_t i) { return bodies[i].velocity; }),
                       writer("angular_velocity", n, [&](std::size_t i) { return bodies[i].angular_velocity; }),
                       writer("mass", n, [&](std::size_t i) { return mass_properties(described[i]).mass; }),
                       writer("asleep", n, [&](std::size_t i) { return bodies[i].asleep; }),
                       writer("exists", n, [&](std::size_t i) { return bodies[i].exists; })});
    });
}

scree_result scree_world_read_of(scree_world* world, const int64_t* bodies, size_t count, const scree_output* outputs,
                                 size_t output_count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> of = bodies_of(used->world, bodies, count);
        const auto asks = [&](const char* prefix) {
            for (std::size_t i = 0; i < output_count && outputs != nullptr; ++i)
                if (text_or_none(outputs[i].name, "the name of an output").starts_with(prefix)) return true;
            return false;
        };
        const std::vector<BodyFrame> frames = asks("origin_") ? used->world.origins(of) : std::vector<BodyFrame>();
        const std::vector<vec3> forces = asks("touch_force") ? used->world.touch_forces(of) : std::vector<vec3>();
        std::vector<BodyState> states;
        if (asks("position") || asks("orientation") || asks("velocity") || asks("angular_velocity"))
            for (const std::size_t body : of) states.push_back(used->world.body(body));
        write_outputs(outputs, output_count, count,
                      {writer("position", count, [&](std::size_t i) { return states[i].position; }),
                       writer("orientation", count, [&](std::size_t i) { return states[i].orientation; }),
                       writer("velocity", count, [&](std::size_t i) { return states[i].velocity; }),
                       writer("angular_velocity", count, [&](std::size_t i) { return states[i].angular_velocity; }),
                       writer("origin_position", count, [&](std::size_t i) { return frames[i].position; }),
                       writer("origin_orientation", count, [&](std::size_t i) { return frames[i].orientation; }),
                       writer("touch_force", count, [&](std::size_t i) { return forces[i]; })});
    });
}

scree_result scree_world_write(scree_world* world, const int64_t* bodies, size_t count, const scree_column* columns,
                               size_t column_count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> of = bodies_of(used->world, bodies, count);
        const Columns given(columns, column_count, count,
                            {{"position", 3}, {"orientation", 4}, {"velocity", 3}, {"angular_velocity", 3}});
        const Rows position = given["position"], orientation = given["orientation"], velocity = given["velocity"],
                   spin = given["angular_velocity"];
        std::vector<BodyChange> changes(count);
        for (std::size_t i = 0; i < count; ++i)
            changes[i] = {of[i], position.maybe<vec3>(i), orientation.maybe<vec4>(i), velocity.maybe<vec3>(i),
                          spin.maybe<vec3>(i)};
        used->world.set_bodies(changes);
    });
}

scree_result scree_world_apply(scree_world* world, const int64_t* bodies, size_t count, const scree_column* columns,
                               size_t column_count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> of = bodies_of(used->world, bodies, count);
        apply(used->world, of,
              Columns(columns, column_count, count,
                      {{"force", 3}, {"torque", 3}, {"impulse", 3}, {"angular_impulse", 3}, {"offset", 3}}));
    });
}

scree_result scree_world_move(scree_world* world, const int64_t* bodies, size_t count, const scree_column* columns,
                              size_t column_count, int steps) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> of = bodies_of(used->world, bodies, count);
        const Columns given(columns, column_count, count, {{"position", 3}, {"orientation", 4}});
        const Rows position = given.required("position"), orientation = given.required("orientation");
        std::vector<BodyTarget> targets(count);
        for (std::size_t i = 0; i < count; ++i) targets[i] = {of[i], position.at<vec3>(i), orientation.at<vec4>(i), steps};
        used->world.move_bodies(targets);
    });
}

scree_result scree_world_add_bodies(scree_world* world, const scree_scene* scene, scree_array* bodies) {
    return called([&] {
        given(bodies, "bodies");
        const UsedWorld used(world);
        const ReadScene from(scene);
        used->require_no_views("added to");
        std::vector<scree_body> made;
        for (const BodyHandle& handle : used->world.add_bodies(from->document.scene.bodies))
            made.push_back({handle.index, handle.generation});
        *bodies = kept_array(std::move(made));
    });
}

scree_result scree_world_remove_bodies(scree_world* world, const scree_body* bodies, size_t count) {
    return called([&] {
        const UsedWorld used(world);
        used->require_no_views("taken from");
        used->world.remove_bodies(body_handles(bodies, count));
    });
}

scree_result scree_world_bodies(scree_world* world, const int64_t* indices, size_t count, scree_body* bodies) {
    return called([&] {
        const UsedWorld used(world);
        given_array(bodies, count, "bodies");
        const std::vector<std::size_t> of = bodies_of(used->world, indices, count);
        std::vector<scree_body> made;
        for (const std::size_t body : of) {
            const BodyHandle handle = used->world.handle_of(body);
            made.push_back({handle.index, handle.generation});
        }
        std::copy(made.begin(), made.end(), bodies);
    });
}

scree_result scree_world_are_valid(scree_world* world, const scree_body* bodies, size_t count, uint8_t* valid) {
    return called([&] {
        const UsedWorld used(world);
        given_array(valid, count, "valid");
        const std::vector<BodyHandle> handles = body_handles(bodies, count);
        for (std::size_t i = 0; i < count; ++i) valid[i] = used->world.is_valid(handles[i]) ? 1 : 0;
    });
}

scree_result scree_world_wake(scree_world* world, const int64_t* bodies, size_t count) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> of = bodies_of(used->world, bodies, count);
        for (const std::size_t body : of) used->world.handle_of(body);  // throws before any wakes
        for (const std::size_t body : of) used->world.wake(body);
    });
}

scree_result scree_world_set_material(scree_world* world, const int64_t* bodies, size_t count, const char* material_json) {
    return called([&] {
        const UsedWorld used(world);
        const std::vector<std::size_t> of = bodies_of(used->world, bodies, count);
        const json given = json_given(material_json, "material_json");
        const Place place = root / "material";
        only(given, place, keys_of<Material>());
        std::vector<Material> made;
        for (const std::size_t body : of) {
            if (!used->world.body(body).exists)
                refuse("body " + std::to_string(body) + " has broken, or is a fragment of one that has not");
            Material& material = made.emplace_back(material_of(used->world.scene().bodies[body]));
            read_fields(given, place, material);
            schema::check_fields(place, material);
        }
        for (std::size_t i = 0; i < count; ++i) used->world.set_material(of[i], made[i]);
    });
}

scree_result scree_world_set_body(scree_world* world, size_t body, const char* what, const char* text) {
    return called([&] {
        const UsedWorld used(world);
        World& of = used->world;
        c::index_of(body, of.scene().bodies.size(), "body");
        const std::string asked = text_of(what, "what");
        const json value = json_given(text, "json");
        if (asked == "mass")
            of.set_mass(body, value_from<float>(value, "mass"));
        else if (asked == "filter")
            of.set_filter(body, value_from<Filter>(value, "filter"));
        else if (asked == "motion")
            of.set_motion(body, value_from<Motion>(value, "motion"));
        else
            refuse(unknown("what", asked, {"mass", "filter", "motion"}));
    });
}

scree_result scree_world_set_exclusion(scree_world* world, size_t a, size_t b, int excluded) {
    return called([&] { UsedWorld(world)->world.set_exclusion(a, b, excluded != 0); });
}

scree_result scree_world_set(scree_world* world, const char* what, const char* text) {
    return called([&] {
        const UsedWorld used(world);
        set_of_world(used->world, text_of(what, "what"), json_given(text, "json"));
    });
}

scree_result scree_world_explode(scree_world* world, const float centre[3], float radius, float speed) {
    return called([&] { UsedWorld(world)->world.explode(three_of(centre, "centre"), radius, speed); });
}

scree_result scree_world_grip(scree_world* world, size_t body, const float anchor[3], const float target[3],
                              const scree_grip_options* options, size_t* grip) {
    return called([&] {
        given(grip, "grip");
        const UsedWorld used(world);
        const scree_grip_options chosen = options_of(options);
        GripSpring spring;
        if (chosen.hertz != 0) spring.hertz = chosen.hertz;
        if (chosen.damping_ratio != 0) spring.damping_ratio = chosen.damping_ratio;
        if (chosen.max_acceleration != 0) spring.max_acceleration = chosen.max_acceleration;
        if (chosen.spin_damping != 0) spring.spin_damping = chosen.spin_damping;
        *grip = used->world.grip(body, three_of(anchor, "anchor"), three_of(target, "target"), spring);
    });
}

scree_result scree_world_move_grip(scree_world* world, size_t grip, const float target[3]) {
    return called([&] { UsedWorld(world)->world.move_grip(grip, three_of(target, "target")); });
}

scree_result scree_world_release_grip(scree_world* world, size_t grip) {
    return called([&] { UsedWorld(world)->world.release(grip); });
}

scree_result scree_world_view(scree_world* world, const char* name, scree_view** view, scree_array* rows) {
    return called([&] {
        given(view, "view");
        given(rows, "rows");
        const UsedWorld used(world);
        World& of = used->world;
        if (of.runner().backend() != "cpu")
            throw Failure(SCREE_IMPOSSIBLE, "the tables of this world are on " + of.runner().device() +
                                                "; scree_world_read copies them, and the backend \"cpu\" keeps them here");
        const State& state = of.state();
        const auto shown = [&](const auto& table) {
            return scree_array{table.data(), std::min<std::size_t>(state.fixed().bodies, table.size()), sizeof table.front()};
        };
        static_assert(sizeof(bool) == 1);
        static_assert(sizeof(physics::Pose) == 32 && sizeof(physics::Velocity) == 32);
        const std::string wanted = text_of(name, "name");
        scree_array made{};
        if (wanted == "poses")
            made = shown(state.poses);
        else if (wanted == "velocities")
            made = shown(state.velocities);
        else if (wanted == "ids")
            made = shown(state.ids);
        else
            refuse(unknown("name", wanted, {"poses", "velocities", "ids"}));
        *view = handle_of(std::make_shared<ViewObject>(ViewObject{used.shared()}));
        ++used->views;
        *rows = made;
    });
}

void scree_view_release(scree_view* view) {
    if (const auto object = std::static_pointer_cast<ViewObject>(ended(HandleKind::view, view))) --object->world->views;
}

scree_result scree_world_view_count(scree_world* world, size_t* views) {
    return called([&] { given(views, "views") = UsedWorld(world)->views; });
}

scree_result scree_world_row_of(scree_world* world, size_t body, size_t* row) {
    return called([&] { given(row, "row") = UsedWorld(world)->world.row_of(body); });
}
