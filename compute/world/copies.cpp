// World: many copies of a scene: their bodies, gravity, and their way back to the start.
#include "compute/scene/copies.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <stdexcept>
#include <string>

#include "compute/compile/joint_blocks.h"
#include "compute/compile/scene_compiler.h"
#include "compute/statistics.h"
#include "compute/world/world_impl.h"
#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

void World::Impl::require_copy(std::size_t copy) const {
    if (copy < copies()) return;
    throw std::out_of_range("copy " + std::to_string(copy) + " of " + std::to_string(copies()));
}

void World::Impl::require_one_copy(const std::string& what) const {
    if (!state.has_copies()) return;
    throw std::logic_error(what + ": the world has " + std::to_string(copies()) +
                           (copies() == 1 ? " copy of its scene" : " copies of its scene"));
}

void World::Impl::require_copies(const std::string& what) const {
    if (!state.has_copies()) throw std::logic_error(what + ": the world was not made with copies of its scene");
}

// ---- gravity
vec3 World::Impl::gravity_of(std::size_t copy) const {
    if (state.gravities.empty()) return scene.gravity;
    const physics::uvec4& words = state.gravities[copy];
    return {std::bit_cast<float>(words.x), std::bit_cast<float>(words.y), std::bit_cast<float>(words.z)};
}

void World::Impl::set_gravities(const std::vector<vec3>& gravities) {
    const TableLengths before = TableLengths::of(state);
    state.gravities = records_of_gravities(gravities);
    state.allocate();
    send({{Table::gravities, 0, state.gravities.size()}}, before);
}

void World::set_gravity_of(std::size_t copy, vec3 gravity) {
    Impl& in = whole();
    in.require_copy(copy);
    gravity = checked(Scene{gravity, {}, {}}).gravity;
    if (!in.state.has_copies()) return set_gravity(gravity);
    std::vector<vec3> gravities;
    for (std::size_t i = 0; i < in.copies(); ++i) gravities.push_back(i == copy ? gravity : in.gravity_of(i));
    in.set_gravities(gravities);
    in.wake_copy(copy);
}

// ---- rows
// The rows of bodies and parts, as runs.
TableRanges World::Impl::rows_of_copies(std::span<const std::size_t> which, const std::vector<Table>& tables) const {
    const physics::Parameters& p = state.fixed();
    const std::size_t n = p.bodies_of_copy, parts = (p.bodies - p.first_part) / p.copies;
    std::vector<std::size_t> rows;
    for (const std::size_t copy : which)
        for (std::size_t i = 0; i < n; ++i) rows.push_back(state.row_of(copy * n + i));
    if (state.reordered()) std::sort(rows.begin(), rows.end());
    for (const std::size_t copy : which)
        for (std::size_t i = 0; i < parts; ++i) rows.push_back(p.first_part + copy * parts + i);
    TableRanges runs;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (i > 0 && rows[i] == rows[i - 1] + 1)
            ++runs.back().count;
        else
            runs.push_back({Table::poses, rows[i], 1});
    TableRanges ranges;
    for (const Table table : tables)
        for (TableRange run : runs) {
            run.table = table;
            ranges.push_back(run);
        }
    return ranges;
}

void World::Impl::wake_copy(std::size_t copy) {
    if (!state.has_copies()) {
        state.fixed().wake_all = 1;
        return;
    }
    const TableRanges ranges = rows_of_copies({&copy, 1}, {Table::sleep_states});
    runner->download(ranges);
    for (const TableRange& range : ranges)
        for (std::size_t row = range.first; row < range.first + range.count; ++row)
            state.sleep_states[row] = physics::roused(state.sleep_states[row], state.fixed().sleep_steps);
    runner->upload(ranges);
}

// ---- back to the start
void World::Impl::keep_start() {
    start.rows.clear();
    for (std::size_t row = 0; row < state.fixed().bodies; ++row) start.rows.push_back(RowRecords::of(state, row));
    if (state.fixed().vehicles) start.vehicles = state.vehicles;
}

// All but what says which joint it is, and its springs and motors as they are at present.
void World::Impl::reset_joints(std::size_t copy, TableRanges& changed) {
    const std::size_t joints = scene.joints.size() / copies(), records = state.joints.size() / copies();
    for (std::size_t i = copy * records; i < (copy + 1) * records; ++i) {
        physics::Joint& joint = state.joints[i];
        for (physics::JointRow& row : joint.rows) row = {};
        for (physics::JointRotor& rotor : joint.rotors) rotor = {rotor.inertia, 0, 0, 0};
        joint.active_set = joint.broken = joint.solved_axes = 0;
        joint.force = joint.torque = vec3(0);
        joint.max_force = joint.max_torque = 0;
    }
    for (std::size_t j = copy * joints; j < (copy + 1) * joints; ++j) {
        physics::Joint& joint = state.joints[state.joint_records[j]];
        const JointAxes made = axes_of_kind(scene.joints[j].kind);
        for (std::size_t k = 0; k < 6; ++k) set_axis_record(joint, made, k);
        joint.broken = scene.joints[j].broken;
    }
    start_joints(state, scene, copy * joints, (copy + 1) * joints);
    changed.push_back({Table::joints, copy * records, records});
}

void World::Impl::reset(std::span<const std::size_t> which) {
    if (which.empty()) return;
    const physics::Parameters& p = state.fixed();
    const std::size_t n = p.bodies_of_copy;
    TableRanges changed = rows_of_copies(which, tables_of_owners());
    if (state.changes_motions()) append(changed, rows_of_copies(which, {Table::properties}));
    for (const TableRange& run : rows_of_copies(which, {Table::poses}))
        for (std::size_t row = run.first; row < run.first + run.count; ++row) {
            const std::size_t place = row < p.first_part ? state.id_of(static_cast<std::uint32_t>(row)) : row;
            RowRecords at_start = start.rows[place];
            at_start.properties = state.properties[row];
            at_start.put(state, row);
            if (row >= p.first_part) continue;
            Body& body = scene.bodies[place];
            state.properties[row].motion =
                body.piece_of == no_body ? static_cast<physics::uint>(body.motion) : physics::MOTION_PENDING;
            if (body.motion != Motion::fixed || std::holds_alternative<Plane>(body.shape)) continue;
            const physics::Pose& pose = at_start.poses;
            if (body.position == pose.position && body.orientation == pose.orientation) continue;
            body.position = pose.position;
            body.orientation = pose.orientation;
            edits.clear();
        }
    const std::size_t vehicles = scene.vehicles.size() / copies();
    for (const std::size_t copy : which) {
        if (!scene.joints.empty()) reset_joints(copy, changed);
        for (std::size_t v = copy * vehicles; v < (copy + 1) * vehicles; ++v) state.vehicles[v] = start.vehicles[v];
        if (vehicles > 0) changed.push_back({Table::vehicles, copy * vehicles, vehicles});
        const std::size_t bonds = scene.bonds.size() / copies();
        for (std::size_t i = copy * bonds; i < (copy + 1) * bonds; ++i) state.bond_states[i] = scene.bonds[i].broken;
        if (bonds > 0) changed.push_back({Table::bond_states, copy * bonds, bonds});
        state.births[copy] = state.counted().steps;
        changed.push_back({Table::births, copy, 1});
        const auto drop = [&](auto& by_body) {
            by_body.erase(by_body.lower_bound(copy * n), by_body.lower_bound((copy + 1) * n));
        };
        drop(actions);
        drop(arrivals);
        for (std::optional<Held>& grip : grips)
            if (grip && copy_of(grip->body) == copy) grip.reset();
    }
    runner->upload(changed);
    ++changes;
}

void World::reset(std::span<const std::uint8_t> mask) {
    Impl& in = whole();
    in.require_copies("reset");
    if (mask.size() != in.copies())
        throw std::invalid_argument("reset: a mask of " + std::to_string(mask.size()) + " for " + std::to_string(in.copies()) +
                                    " copies");
    std::vector<std::size_t> which;
    for (std::size_t copy = 0; copy < mask.size(); ++copy)
        if (mask[copy]) which.push_back(copy);
    in.reset(which);
}

void World::reset_copy(std::size_t copy) {
    whole().require_copies("reset");
    whole().require_copy(copy);
    whole().reset({&copy, 1});
}

// ---- asking
std::size_t World::copies() const {
    return local().copies();
}
std::size_t World::bodies_of_copy() const {
    const Impl& in = local();
    return in.state.has_copies() ? in.state.fixed().bodies_of_copy : in.bodies();
}
std::size_t World::body_of(std::size_t copy, std::size_t body) const {
    whole().require_copy(copy);
    if (body >= bodies_of_copy())
        throw std::out_of_range("body " + std::to_string(body) + " of " + std::to_string(bodies_of_copy()) + " in a copy");
    return copy * bodies_of_copy() + body;
}
std::size_t World::copy_of(std::size_t body) const {
    whole().require_body(body);
    return whole().copy_of(body);
}
vec3 World::gravity_of(std::size_t copy) const {
    whole().require_copy(copy);
    return whole().gravity_of(copy);
}
void World::wake_copy(std::size_t copy) {
    whole().require_copy(copy);
    whole().wake_copy(copy);
}

std::uint64_t World::state_hash_of(std::size_t copy) const {
    whole().require_copy(copy);
    if (!whole().state.has_copies()) return state_hash();
    whole().bring(body_ranges);
    return hash_of(whole().state, static_cast<std::uint32_t>(copy));
}

std::vector<std::uint64_t> World::state_hashes() const {
    if (!whole().state.has_copies()) return {state_hash()};
    whole().bring(body_ranges);
    std::vector<std::uint64_t> hashes(copies());
    whole().runner->threads().for_each(
        hashes.size(), [&](std::size_t copy) { hashes[copy] = hash_of(whole().state, static_cast<std::uint32_t>(copy)); });
    return hashes;
}

Statistics World::statistics_of(std::size_t copy) const {
    const Impl& in = whole();
    in.require_copy(copy);
    if (!in.state.has_copies()) return statistics();
    in.bring(body_ranges);
    in.bring(contact_ranges);
    in.bring(joint_ranges);
    in.bring(bond_ranges);
    const auto one = static_cast<std::uint32_t>(copy);
    return scree::statistics_of(in.scene, in.state, contact_sums(in.state, one), one);
}

}  // namespace scree
