// World: changing bodies: poses and velocities in bulk, materials, filters, motion.
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "compute/compile/state_editor.h"
#include "compute/scene/double_quaternion.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/body.h"
#include "compute/schema/check.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

bool all_within(vec3 v, float limit) {
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

// Checked as in a scene, but as an argument.
void check(const BodyChange& change, const Body& body, const std::string& name) {
    const auto demand = [&](bool condition, const char* what) {
        if (!condition) throw std::invalid_argument(name + ": " + what);
    };
    demand(!change.position || all_within(*change.position, 1e6f), "the position must be within 1000000 m of 0");
    if (change.orientation) {
        const vec4 q = *change.orientation;
        const double squared = glm::dot(glm::dvec4(q), glm::dvec4(q));
        demand(std::isfinite(squared) && squared >= 1e-12, "the orientation must be finite and not of length 0");
    }
    for (const auto& velocity : {change.velocity, change.angular_velocity})
        demand(!velocity || all_within(*velocity, 1e4f), "velocities must be within 10000 of 0 along each axis");
    if (body.motion == Motion::fixed)
        demand(!change.velocity && !change.angular_velocity, "a fixed body has no velocity; make it kinematic");
    if (std::holds_alternative<Plane>(body.shape))
        demand(!change.position && !change.orientation, "a plane has no pose, but a normal and an offset");
}

// As in a scene: what is of unit length, to rounding, stays.
vec4 unit(vec4 q) {
    schema::make_unit(Examination(), q, "");
    return q;
}

// Ranges of several tables for ascending rows.
TableRanges ranges_of(const std::vector<std::uint32_t>& rows, std::initializer_list<Table> tables) {
    TableRanges ranges;
    for (const Table table : tables)
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (i > 0 && !ranges.empty() && ranges.back().table == table && ranges.back().first + ranges.back().count == rows[i])
                ++ranges.back().count;
            else
                ranges.push_back({table, rows[i], 1});
    return ranges;
}

}  // namespace

void World::Impl::require_there(std::size_t body) const {
    if (!physics::is_absent(state.properties[state.row_of(body)].motion)) return;
    throw std::invalid_argument(name_of_body(body) + " is not there: it has broken, or is a fragment of one that has not");
}

void World::Impl::set(std::span<const BodyChange> bodies) {
    if (bodies.empty()) return;
    std::vector<std::uint32_t> rows;
    for (const BodyChange& change : bodies) {
        require_body(change.body);
        check(change, scene.bodies[change.body], name_of_body(change.body));
        rows.push_back(state.row_of(change.body));
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    TableRanges changed = ranges_of(rows, {Table::poses, Table::velocities, Table::sleep_states});
    TableRanges needed = changed;
    if (state.changes_motions()) append(needed, ranges_of(rows, {Table::properties}));
    if (state.counted().quarantined > 0) append(needed, ranges_of(rows, {Table::masses}));
    runner->download(needed);
    for (const BodyChange& change : bodies) require_there(change.body);
    std::set<std::size_t> woken;  // copies
    for (const BodyChange& change : bodies) {
        const std::uint32_t row = state.row_of(change.body);
        physics::Pose& pose = state.poses[row];
        physics::Velocity& velocity = state.velocities[row];
        const physics::Velocity before = velocity;
        if (change.position && physics::is_quarantined(state.properties[row].motion)) {  // it begins anew
            state.properties[row].motion = static_cast<physics::uint>(scene.bodies[change.body].motion);
            velocity = {};
            state.masses[row] = {};
            changed.push_back({Table::properties, row, 1});
            changed.push_back({Table::masses, row, 1});
        }
        if (change.position) {
            pose.position = physics::flush_tiny(*change.position);
            pose.low_x = velocity.low_y = velocity.low_z = 0;
        }
        if (change.orientation) pose.orientation = physics::flush_tiny(unit(*change.orientation));
        if (change.velocity) velocity.linear = physics::flush_tiny(*change.velocity);
        if (change.angular_velocity) velocity.angular = physics::flush_tiny(*change.angular_velocity);
        state.sleep_states[row] = scene.bodies[change.body].motion == Motion::dynamic ? physics::RESTARTS : 0;
        arrivals.erase(change.body);
        const Body& body = scene.bodies[change.body];
        if (body.motion == Motion::kinematic && (change.velocity || change.angular_velocity)) {
            physics::Action& action = change_velocity(change.body, before);
            action.flags |= physics::ACTION_SETS_VELOCITY;
            action.velocity = velocity.linear;
            action.angular_velocity = velocity.angular;
        }
        if (change.position || change.orientation) jump_to_velocity(change.body);
        if (body.motion == Motion::dynamic || !(change.position || change.orientation)) continue;
        woken.insert(copy_of(change.body));
        append(changed, StateEditor(state).place_parts(static_cast<std::uint32_t>(change.body)));
        if (body.motion != Motion::fixed) continue;
        keep_original(change.body);
        scene.bodies[change.body].position = pose.position;
        scene.bodies[change.body].orientation = pose.orientation;
        edits.clear();
    }
    runner->upload(changed);
    for (const std::size_t copy : woken) wake_copy(copy);
    ++changes;
}

void World::set_bodies(std::span<const BodyChange> changes) {
    whole().set(changes);
}

std::vector<BodyFrame> World::origins(std::span<const std::size_t> bodies) const {
    for (const std::size_t body : bodies) whole().require_body(body);
    whole().bring(body_ranges);
    std::vector<BodyFrame> found;
    for (const std::size_t body : bodies) {
        const BodyState now = whole().body_state(body);
        found.push_back({now.position, now.orientation});
        const std::optional<BodyFrame>& origin = whole().scene.bodies[body].origin;
        if (!origin) continue;
        const glm::dquat turn = glm::normalize(double_quaternion(now.orientation));
        found.back().position = vec3(glm::dvec3(now.position) + turn * glm::dvec3(origin->position));
        found.back().orientation = single_quaternion(glm::normalize(turn * double_quaternion(origin->orientation)));
    }
    return found;
}

// Changes a body of the scene, checks it, and tells the runner.
void World::Impl::change(std::size_t index, const std::function<void(Body&)>& edit, bool wakes_all) {
    require_body(index);
    if (state.changes_motions()) runner->download(row_ranges(state, state.row_of(index)));
    require_there(index);
    Body& body = scene.bodies[index];
    Shape shape = std::exchange(body.shape, Box{});
    Body changed = body;
    body.shape = std::move(shape);
    edit(changed);
    schema::check_fields(Examination("bodies", "body", index, body.name), changed);
    keep_original(index);
    shape = std::move(body.shape);
    body = std::move(changed);
    body.shape = std::move(shape);
    const TableLengths before = TableLengths::of(state);
    send(StateEditor(state).change(body, static_cast<std::uint32_t>(index)), before);
    if (wakes_all || body.motion != Motion::dynamic)
        wake_copy_of(index);
    else
        actions[index];
    edits.clear();
}

void World::set_material(std::size_t body, const Material& material) {
    whole().change(
        body, [&](Body& b) { scree::set_material(b, material); }, false);
}

void World::set_mass(std::size_t body, float mass) {
    Impl& in = whole();
    in.require_body(body);
    const Body& now = in.scene.bodies[body];
    const auto refuse = [&](const std::string& reason) {
        throw SceneError("/bodies/" + std::to_string(body) + "/mass",
                         reason + (now.name.empty() ? "" : " (body \"" + now.name + "\")"));
    };
    if (!(mass >= 1e-9f && mass <= 1e15f)) refuse("must be between 1e-9 and 1e15 kg");
    if (std::holds_alternative<Plane>(now.shape) || std::holds_alternative<Mesh>(now.shape) ||
        std::holds_alternative<HeightField>(now.shape))
        refuse("a plane, mesh or height field has no mass");
    if (now.fracture || now.piece_of != no_body)
        refuse("a body that can break, and its fragments, have the mass of their shapes at their density");
    const MassProperties before = mass_properties(now);
    const Inertial made{.mass = mass, .inertia = before.inertia * (mass / before.mass)};
    for (const float value : {made.inertia.x, made.inertia.y, made.inertia.z})
        if (!std::isnormal(value) || !std::isnormal(1 / value)) refuse("gives an inertia out of the range of a float");
    in.change(
        body, [&](Body& b) { b.inertial = made; }, false);
}

void World::Impl::refilter(std::size_t body) {
    const TableLengths before = TableLengths::of(state);
    send(StateEditor(state).filter(scene), before);
    wake_copy_of(body);
    edits.clear();
    ++changes;
}

void World::set_filter(std::size_t body, const Filter& filter) {
    Impl& in = whole();
    in.require_body(body);
    in.keep_original(body);
    in.scene.bodies[body].filter = filter;
    in.refilter(body);
}

void World::set_exclusion(std::size_t a, std::size_t b, bool excluded) {
    Impl& in = whole();
    in.require_body(a);
    in.require_body(b);
    if (a == b) throw std::invalid_argument("body " + std::to_string(a) + " cannot collide with itself");
    if (in.copy_of(a) != in.copy_of(b))
        throw std::invalid_argument("bodies " + std::to_string(a) + " and " + std::to_string(b) +
                                    " are in two copies of the scene, which never meet");
    std::erase_if(in.scene.exclusions, [&](const Exclusion& e) { return e == Exclusion{a, b} || e == Exclusion{b, a}; });
    if (excluded) in.scene.exclusions.push_back({a, b});
    in.refilter(a);
}

void World::set_motion(std::size_t body, Motion motion) {
    Impl& in = whole();
    in.require_body(body);
    const Body& now = in.scene.bodies[body];
    const auto refuse = [&](const std::string& reason) {
        throw SceneError("/bodies/" + std::to_string(body) + "/motion",
                         reason + (now.name.empty() ? "" : " (body \"" + now.name + "\")"));
    };
    if (now.motion == motion) return;
    if (std::holds_alternative<Plane>(now.shape)) refuse("a plane must be \"fixed\": it is infinite and cannot move");
    const bool surface = std::holds_alternative<Mesh>(now.shape) || std::holds_alternative<HeightField>(now.shape);
    if (motion == Motion::dynamic && surface) refuse("a mesh or height field is a surface, has no mass and cannot be dynamic");
    if (motion == Motion::dynamic) {
        const MassProperties mass = mass_properties(now);
        for (const float value : {mass.mass, mass.inertia.x, mass.inertia.y, mass.inertia.z})
            if (!std::isnormal(value) || !std::isnormal(1 / value))
                refuse("size and density give a mass or inertia out of the range of a float");
    }
    if (motion != Motion::dynamic && (now.fracture || now.piece_of != no_body))
        refuse("only a dynamic body can break, or be a fragment");
    bool joined = false;
    for (std::size_t j = 0; j < in.scene.joints.size(); ++j) {
        const Joint& joint = in.scene.joints[j];
        if ((joint.a != body && joint.b != body) || joint.broken) continue;
        joined = true;
        const std::size_t other = joint.a == body ? joint.b : joint.a;
        if (motion != Motion::dynamic && (other == the_world || in.scene.bodies[other].motion != Motion::dynamic))
            refuse("joint " + std::to_string(j) + " would join two bodies that never move; remove it first");
    }
    for (const Vehicle& vehicle : in.scene.vehicles) {
        const bool wheel = std::any_of(vehicle.wheels.begin(), vehicle.wheels.end(),
                                       [&](const Wheel& one) { return in.scene.joints[one.joint].b == body; });
        if (vehicle.chassis == body || wheel) refuse("the bodies of a vehicle must be dynamic");
    }
    in.change(
        body, [&](Body& b) { b.motion = motion; }, true);
    in.arrivals.erase(body);
    for (auto& grip : in.grips)
        if (grip && grip->body == body && motion != Motion::dynamic) grip.reset();
    if (motion == Motion::fixed) {
        in.actions.erase(body);
        const std::uint32_t row = in.state.row_of(body);
        const TableRanges still{{Table::velocities, row, 1}};
        in.runner->download({{Table::poses, row, 1}, {Table::velocities, row, 1}});
        in.state.velocities[row] = {};
        in.scene.bodies[body].position = in.state.poses[row].position;
        in.scene.bodies[body].orientation = in.state.poses[row].orientation;
        in.scene.bodies[body].velocity = in.scene.bodies[body].angular_velocity = vec3(0);
        TableRanges changed = still;
        append(changed, StateEditor(in.state).place_parts(static_cast<std::uint32_t>(body)));
        in.runner->upload(changed);
    }
    if (joined) in.rejoin();
}

}  // namespace scree
