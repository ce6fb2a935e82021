// Edits of a running world's tables. Joint blocks and lists are rebuilt; other lasting data stays.
#include "compute/compile/state_editor.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "compute/compile/grid_layout.h"
#include "compute/compile/joint_blocks.h"
#include "compute/compile/scene_compiler.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/contact/material.h"

namespace scree {

namespace {

physics::Impulse scaled(physics::Impulse impulse, float factor) {
    impulse.normal *= factor;
    impulse.impact *= factor;
    impulse.rebound_energy *= factor;
    impulse.impact_energy *= factor;
    impulse.impact_weight *= factor;
    impulse.friction *= factor;
    impulse.twist *= factor;
    impulse.rolling *= factor;
    impulse.normal_sum *= factor;
    return impulse;
}

// Adds a record to runs, which are ascending.
void add_to_run(TableRanges& runs, Table table, std::size_t record) {
    if (runs.empty() || runs.back().first + runs.back().count != record) runs.push_back({table, record, 0});
    ++runs.back().count;
}

// Runs of records that differ.
template <typename Record>
TableRanges differing(Table table, const std::vector<Record>& before, const std::vector<Record>& now) {
    TableRanges runs;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (i < before.size() && std::memcmp(&before[i], &now[i], sizeof(Record)) == 0) continue;
        add_to_run(runs, table, i);
    }
    return runs;
}

// Tables with shape data of bodies.
constexpr std::array shape_tables{Table::hulls, Table::parts, Table::fractures, Table::pieces, Table::tyres, Table::surfaces};
using ShapeLengths = std::array<std::size_t, shape_tables.size()>;  // records

ShapeLengths shape_lengths(const State& state) {
    ShapeLengths lengths;
    for (std::size_t i = 0; i < shape_tables.size(); ++i)
        lengths[i] = state.raw(shape_tables[i]).size() / table_infos()[static_cast<std::size_t>(shape_tables[i])].record_bytes;
    return lengths;
}

TableRanges shapes_added(const State& state, const ShapeLengths& before) {
    TableRanges added;
    const ShapeLengths now = shape_lengths(state);
    for (std::size_t i = 0; i < shape_tables.size(); ++i)
        if (now[i] > before[i]) added.push_back({shape_tables[i], before[i], now[i] - before[i]});
    return added;
}

// A spare row between bodies and parts.
physics::BodyProperties spare_row(std::uint32_t row) {
    physics::BodyProperties spare{};
    spare.motion = physics::MOTION_PENDING;
    spare.shape = physics::SHAPE_NONE;
    spare.owner = row;
    spare.fracture = spare.joints = physics::NONE;
    return spare;
}

}  // namespace

TableRanges StateEditor::needed_to_tune(const Settings& settings) const {
    if (settings.substeps == state_.substeps) return {};
    const std::size_t contacts = state_.live(BufferLength::contacts);
    TableRanges needed = joint_ranges(state_);
    append(needed, {{Table::contacts, 0, contacts}, {Table::impulses, 0, contacts}});
    if (state_.bounces()) needed.push_back({Table::impacts, 0, contacts});
    return needed;
}

TableRanges StateEditor::tune(vec3 gravity, const Settings& settings) {
    const float h_before = state_.fixed().h;
    state_.fixed() = tuned(state_.fixed(), gravity, settings);
    state_.fit_tables();
    const TableRanges changed = needed_to_tune(settings);
    if (settings.substeps == state_.substeps) return {};
    state_.substeps = settings.substeps;
    const float factor = state_.fixed().h / h_before;
    const std::size_t lasting =
        std::min<std::size_t>(state_.counted().contacts, std::min(state_.contacts.size(), state_.impulses.size()));
    for (std::size_t i = 0; i < lasting; ++i) {
        state_.keep_impulse(i, scaled(state_.impulse(i), factor));
        state_.contacts[i].load *= factor;
    }
    for (physics::Joint& joint : state_.joints) {
        for (physics::JointRow& row : joint.rows) {
            row.motor_impulse *= factor;
            row.limit_impulse *= factor;
        }
        for (physics::JointRotor& rotor : joint.rotors) rotor.impulse *= factor;
    }
    return changed;
}

bool StateEditor::has_room_for(std::uint32_t bodies, bool with_parts) const {
    const physics::Parameters& p = state_.fixed();
    const bool at_the_end = p.first_part == p.bodies && !(with_parts && bodies > 1);
    return bodies == 0 || state_.body_count + bodies <= p.first_part || at_the_end;
}

// Rows of parts, which move, and contacts, which refer to rows.
TableRanges StateEditor::needed_to_add(std::uint32_t count, bool with_parts) const {
    if (has_room_for(count, with_parts)) return {};
    const physics::Parameters& p = state_.fixed();
    const std::size_t parts = p.bodies - p.first_part;
    TableRanges needed{{Table::first_contacts, p.first_part, parts + 1},
                       {Table::contacts, 0, state_.live(BufferLength::contacts)}};
    append_rows(needed, p.first_part, parts);
    return needed;
}

// Inserts spare rows between bodies and parts, which move up.
TableRanges StateEditor::make_room(std::uint32_t bodies, bool with_parts) {
    if (has_room_for(bodies, with_parts)) return {};
    physics::Parameters& p = state_.fixed();
    const std::uint32_t first = p.first_part, count = std::max({16u, first / 2, bodies});
    const auto insert = [&](auto& table, const auto& record) { table.insert(table.begin() + first, count, record); };
#define SCREE_INSERT(name, travel) insert(state_.name, physics::records::name{});
    SCREE_LASTING_OF_ROWS(SCREE_INSERT)
#undef SCREE_INSERT
    for (std::uint32_t row = first; row < first + count; ++row) empty_row(row, row);
    // Spare rows have no contacts: an empty range.
    insert(state_.first_contacts, physics::uint{state_.first_contacts[first]});
    TableRanges changed;
    for (std::size_t i = 0; i < state_.live(BufferLength::contacts); ++i) {
        physics::Contact& contact = state_.contacts[i];
        if (contact.a < first && contact.b < first) continue;
        for (physics::uint* row : {&contact.a, &contact.b})
            if (*row >= first) *row += count;
        add_to_run(changed, Table::contacts, i);
    }
    p.first_part += count;
    p.bodies += count;
    p.buckets = std::max(p.buckets, State::buckets_for(p.bodies));
    state_.allocate();
    changed.push_back({Table::first_contacts, first, p.bodies + 1 - first});
    append_rows(changed, first, p.bodies - first);
    changed.push_back({Table::ids, first, p.bodies - first});
    if (!state_.filters.empty()) changed.push_back({Table::filters, first, p.bodies - first});
    return changed;
}

void StateEditor::choose_cell() {
    GridLayout layout;
    for (const physics::BodyProperties& row : state_.properties) layout.note_width(row, state_.fixed());
    layout.choose_cell(state_.fixed());
}

// Initial lasting data of new rows: parts follow their bodies, and there are no contacts.
TableRanges StateEditor::rows_added(std::uint32_t first, std::uint32_t count) {
    if (count == 0) return {};
    for (std::uint32_t row = first; row < first + count; ++row) state_.first_contacts[row + 1] = state_.counted().contacts;
    TableRanges added{{Table::first_contacts, first + 1, count}};
    append_rows(added, first, count);
    added.push_back({Table::ids, first, count});
    if (!state_.filters.empty()) added.push_back({Table::filters, first, count});
    return added;
}

TableRanges StateEditor::put(const Body& body, std::uint32_t id) {
    const bool appended = id == state_.body_count;
    TableRanges changed = appended ? make_room(1) : TableRanges{};
    SceneCompiler compiler(state_);
    physics::Parameters& p = state_.fixed();
    const std::uint32_t row = appended ? id : state_.row_of(id), rows_before = p.bodies;
    const ShapeLengths before = shape_lengths(state_);
    if (appended) {
        state_.append_row(row);
        ++state_.body_count;
        if (row == p.first_part) ++p.first_part;
        state_.properties.resize(std::max(rows_before, row + 1));  // an empty table has a record all the same
    }
    state_.properties[row] = compiler.properties_of(body, row);
    std::uint32_t first_part = std::max(rows_before, row + 1);
    compiler.append_parts(body, row);
    const auto parts = static_cast<std::uint32_t>(state_.properties.size()) - first_part;
    const std::optional<std::uint32_t> spare = parts > 0 ? state_.spare.take_parts(parts) : std::nullopt;
    if (spare) {  // those of a removed body
        std::copy_n(state_.properties.begin() + first_part, parts, state_.properties.begin() + p.first_part + *spare);
        std::copy_n(state_.parts.end() - parts, parts, state_.parts.begin() + *spare);
        state_.properties.resize(first_part);
        state_.parts.resize(state_.parts.size() - parts);
        first_part = p.first_part + *spare;
        changed.push_back({Table::parts, *spare, parts});
    }
    p.bodies = static_cast<std::uint32_t>(state_.properties.size());
    p.buckets = std::max(p.buckets, State::buckets_for(p.bodies));
    state_.make(Table::first_contacts);
    state_.allocate();
    clear_row(row);
    state_.poses[row] = SceneCompiler::start_of(body);
    state_.velocities[row] = SceneCompiler::start_velocity_of(body);
    state_.strains[row] = SceneCompiler::start_strain_of(body, state_.properties[row]);
    for (std::uint32_t part = first_part; part < first_part + parts; ++part) {
        clear_row(part);
        compiler.place(part);
    }
    state_.note_content(row, 1);
    state_.note_content(first_part, parts);
    if (row < rows_before) append_rows(changed, row, 1);
    if (spare) append_rows(changed, first_part, parts);
    if (state_.properties[row].fracture != physics::NONE)
        changed.push_back({Table::fractures, state_.properties[row].fracture, 1});
    append(changed, surface_ranges(row, 1));
    append(changed, surface_ranges(first_part, parts));
    if (!state_.immersions.empty()) {
        state_.immersions.resize(state_.body_count);
        state_.immersions[id] = SceneCompiler::immersion_of(body);
        changed.push_back({Table::immersions, id, 1});
    }
    append(changed, rows_added(rows_before, p.bodies - rows_before));
    append(changed, shapes_added(state_, before));
    return changed;
}

std::pair<std::uint32_t, std::uint32_t> StateEditor::parts_of(std::uint32_t row) const {
    if (state_.properties[row].shape != physics::SHAPE_NONE) return {0, 0};
    const physics::Parameters& p = state_.fixed();
    const auto is_its = [&](std::uint32_t part) {
        return state_.properties[part].owner == row && physics::is_part(state_.properties[part]);
    };
    std::uint32_t first = p.first_part;
    while (first < p.bodies && !is_its(first)) ++first;
    std::uint32_t count = 0;
    while (first + count < p.bodies && is_its(first + count)) ++count;
    return {first, count};
}

// The surfaces of rows: a new one may be in the place of one that no row has any more.
TableRanges StateEditor::surface_ranges(std::uint32_t first, std::uint32_t count) const {
    TableRanges ranges;
    physics::uint last = 0;
    for (std::uint32_t row = first; row < first + count; ++row) {
        const physics::uint surface = physics::surface_of(state_.properties[row]);
        if (surface != 0 && surface != last) ranges.push_back({Table::surfaces, surface - 1, 1});
        last = surface;
    }
    return ranges;
}

TableRanges StateEditor::remove(std::span<const std::uint32_t> ids) {
    std::vector<std::uint32_t> rows;
    for (const std::uint32_t id : ids) {
        const std::uint32_t row = state_.row_of(id);
        const auto [first, count] = parts_of(row);
        rows.push_back(row);
        for (std::uint32_t part = first; part < first + count; ++part) rows.push_back(part);
        if (count > 0) state_.spare.add_parts(first - state_.fixed().first_part, count);
        if (state_.properties[row].fracture != physics::NONE) state_.spare.fractures.push_back(state_.properties[row].fracture);
    }
    std::sort(rows.begin(), rows.end());
    TableRanges runs;
    SceneCompiler compiler(state_);
    for (const std::uint32_t row : rows) {
        compiler.release_surface(state_.properties[row]);
        empty_row(row, row < state_.fixed().first_part ? row : 0);
        add_to_run(runs, Table::properties, row);
    }
    TableRanges changed;
    for (const TableRange& run : runs) append_rows(changed, run.first, run.count);
    return changed;
}

// What lasts of a row begins as nothing; its properties stay.
void StateEditor::clear_row(std::uint32_t row) {
    const physics::BodyProperties properties = state_.properties[row];
    RowRecords{.properties = properties}.put(state_, row);
}

void StateEditor::empty_row(std::uint32_t row, std::uint32_t owner) {
    clear_row(row);
    state_.properties[row] = spare_row(owner);
    state_.poses[row].orientation = vec4(0, 0, 0, 1);
}

TableRanges StateEditor::change(const Body& body, std::uint32_t id) {
    const std::uint32_t row = state_.row_of(id);
    const auto [first, count] = parts_of(row);
    physics::BodyProperties& whole = state_.properties[row];
    SceneCompiler compiler(state_);
    const ShapeLengths before = shape_lengths(state_);
    const bool quarantined = physics::is_quarantined(whole.motion) && body.motion == Motion::dynamic;
    SceneCompiler::set_mass(whole, body);
    if (quarantined) whole.motion = physics::MOTION_QUARANTINED;
    compiler.set_material(whole, body);
    const auto* compound = std::get_if<Compound>(&body.shape);
    const Material own = material_of(body);
    const float curvature = SceneCompiler::curvature_of(body);
    TableRanges changed{{Table::properties, row, 1}};
    for (std::uint32_t part = first; part < first + count; ++part) {
        physics::BodyProperties& one = state_.properties[part];
        one.motion = static_cast<physics::uint>(body.motion) | physics::MOTION_OF_PART;
        compiler.set_surface(one, compound ? compound->parts[part - first].material.value_or(own) : own, curvature);
    }
    state_.note_content(row, 1);
    state_.note_content(first, count);
    if (count > 0) changed.push_back({Table::properties, first, count});
    append(changed, surface_ranges(row, 1));
    append(changed, surface_ranges(first, count));
    append(changed, shapes_added(state_, before));
    state_.allocate();
    return changed;
}

TableRanges StateEditor::place_parts(std::uint32_t id) {
    const auto [first, count] = parts_of(state_.row_of(id));
    if (count == 0) return {};
    SceneCompiler compiler(state_);
    for (std::uint32_t part = first; part < first + count; ++part) compiler.place(part);
    return {{Table::poses, first, count}, {Table::velocities, first, count}, {Table::sleep_states, first, count}};
}

TableRanges StateEditor::set_fields(const Scene& scene) {
    const std::vector<physics::Immersion> before = state_.immersions;
    SceneCompiler(state_).set_fields(scene);
    state_.allocate();
    return differing(Table::immersions, before, state_.immersions);
}

TableRanges StateEditor::filter(const Scene& scene) {
    const std::vector<physics::uvec4> filters_before = state_.filters, exclusions_before = state_.exclusions;
    SceneCompiler(state_).filter(scene);
    TableRanges changed = differing(Table::filters, filters_before, state_.filters);
    append(changed, differing(Table::exclusions, exclusions_before, state_.exclusions));
    return changed;
}

TableRanges StateEditor::needed_to_rejoin(const Scene& scene, std::span<const std::size_t> fresh) const {
    TableRanges needed = joint_ranges(state_);
    append(needed, vehicle_ranges(state_));
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {  // new joints begin at their poses
        if (j < state_.joint_records.size() && std::find(fresh.begin(), fresh.end(), j) == fresh.end()) continue;
        const auto need = [&](const Joint& joint) {
            for (const std::size_t body : {joint.a, joint.b})
                if (body != the_world)
                    for (const Table table : {Table::poses, Table::velocities}) needed.push_back({table, state_.row_of(body), 1});
        };
        need(scene.joints[j]);
        if (const auto* coupling = std::get_if<Coupling>(&scene.joints[j].kind))
            for (const CoupledAxis& term : coupling->joints) need(scene.joints[term.joint]);
    }
    if (state_.changes_motions()) needed.push_back({Table::properties, 0, state_.fixed().bodies});  // which bodies exist
    return needed;
}

TableRanges StateEditor::rejoin(const Scene& scene, std::optional<std::size_t> without, std::span<const std::size_t> fresh) {
    const std::vector<physics::Joint> joints_before = state_.joints;
    const std::vector<physics::JointBlock> blocks_before = state_.joint_blocks;
    const std::vector<physics::BlockBody> bodies_before = state_.block_bodies;
    const std::vector<physics::Vehicle> vehicles_before = state_.vehicles;
    TableRanges changed;
    std::vector<physics::Joint> before;
    for (const std::uint32_t record : state_.joint_records) before.push_back(state_.joints[record]);
    if (without) before.erase(before.begin() + static_cast<std::ptrdiff_t>(*without));
    std::vector<physics::BodyProperties> by_id;
    for (std::size_t id = 0; id < state_.body_count; ++id) {
        by_id.push_back(state_.properties[state_.row_of(id)]);
        by_id.back().joints = physics::NONE;
    }
    JointTables made = joint_tables(scene, by_id);
    for (std::size_t id = 0; id < by_id.size(); ++id) {
        physics::uint& first = state_.properties[state_.row_of(id)].joints;
        if (first == by_id[id].joints) continue;
        first = by_id[id].joints;
        changed.push_back({Table::properties, state_.row_of(id), 1});
    }
    for (physics::Joint& record : made.joints)
        for (physics::uint* body : {&record.a, &record.b})
            if (*body != physics::NONE) *body = state_.row_of(*body);
    for (physics::BlockBody& member : made.bodies) member.body = state_.row_of(member.body);
    take_joint_tables(state_, std::move(made));
    for (std::size_t j = 0; j < state_.joint_records.size(); ++j) {
        physics::Joint& now = state_.joints[state_.joint_records[j]];
        if (j >= before.size() || std::find(fresh.begin(), fresh.end(), j) != fresh.end()) {
            start_joint(state_, now, scene.joints[j]);
            continue;
        }
        const physics::Joint& was = before[j];
        std::copy(std::begin(was.rows), std::end(was.rows), now.rows);  // with their warm start
        for (std::size_t k = 0; k < 6; ++k) {
            now.rotors[k].impulse = was.rotors[k].impulse;
            now.rotors[k].speed = was.rotors[k].speed;
        }
        now.active_set = was.active_set;
        now.twist = was.twist;
        now.broken = was.broken;
        now.force = was.force;
        now.max_force = was.max_force;
        now.torque = was.torque;
        now.max_torque = was.max_torque;
        if ((now.flags & physics::JOINT_COUPLES) != 0) now.anchor_a.x = was.anchor_a.x;
        if ((now.flags & physics::JOINT_CURVED) != 0) now.frame_a = was.frame_a;
    }
    for (std::size_t j = 0; j < state_.joint_records.size(); ++j)
        if (j >= before.size() || std::find(fresh.begin(), fresh.end(), j) != fresh.end())
            start_coupling(state_, state_.joints[state_.joint_records[j]], scene.joints[j]);
    for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
        const std::vector<Wheel>& wheels = scene.vehicles[v].wheels;
        for (std::size_t k = 0; k < wheels.size(); ++k) state_.vehicles[v].wheel[k].joint = state_.joint_records[wheels[k].joint];
    }
    state_.allocate();
    append(changed, differing(Table::joints, joints_before, state_.joints));
    append(changed, differing(Table::joint_blocks, blocks_before, state_.joint_blocks));
    append(changed, differing(Table::block_bodies, bodies_before, state_.block_bodies));
    append(changed, differing(Table::vehicles, vehicles_before, state_.vehicles));
    return changed;
}

}  // namespace scree
