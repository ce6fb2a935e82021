// The tables of a state as bytes.
#include "compute/world/states/state_bytes.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "compute/compile/scene_compiler.h"
#include "compute/tables/table_layout.h"
#include "compute/world/states/state_check.h"
#include "shaders/physics/base/work_counts.h"

namespace scree {

namespace {

std::span<const std::byte> records_of(const State& state, Table table, std::size_t count) {
    return state.raw(table).first(count * record_bytes(table));
}

template <class Record>
std::uint64_t hash_of(const std::vector<Record>& records, std::uint64_t seed) {
    return XXH64(records.data(), records.size() * sizeof(Record), seed);
}

template <class Record>
void assign(std::vector<Record>& records, std::span<const std::byte> bytes, std::size_t after = 0) {
    records.resize(after + bytes.size() / sizeof(Record));
    if (!bytes.empty()) std::memcpy(records.data() + after, bytes.data(), bytes.size());
}

template <class Record>
std::span<const Record> behind(const std::vector<Record>& records, std::size_t first) {
    return std::span(records).subspan(first);
}

// Without what depends on the runner and its buffers: equal states have equal bytes, on every backend.
physics::Parameters portable(physics::Parameters p) {
    tell_offsets({}, p);
    p.group_size = p.group_shift = p.most_groups = p.pair_capacity = p.contact_capacity = p.actions = p.redo = 0;
    p.held = 0;  // those in use are written before each step
    for (physics::Grip& grip : p.grips) grip = {};
    return p;
}
physics::Counts portable(const physics::Counts& counts) {
    physics::Counts kept{};
    kept.contacts = counts.contacts;
    kept.steps = counts.steps;
    kept.spin_limited = counts.spin_limited;
    kept.quarantined = counts.quarantined;
    return kept;
}

// Without what each step writes before it reads.
std::vector<physics::JointBlock> portable(std::vector<physics::JointBlock> blocks) {
    for (physics::JointBlock& block : blocks) block.restless = block.unsettled = 0;
    return blocks;
}
std::vector<physics::BlockBody> portable(std::vector<physics::BlockBody> members) {
    for (physics::BlockBody& member : members) member = {.body = member.body, .slot = physics::NONE, .blocks = member.blocks};
    return members;
}

[[noreturn]] void refuse() {
    throw CheckpointError("the checkpoint is damaged: its tables do not fit together");
}

}  // namespace

std::vector<std::pair<Table, std::size_t>> stepped_tables(std::size_t rows, std::size_t contacts, bool bounces,
                                                          SteppedTables which) {
    if (which == SteppedTables::on_device) return {{Table::properties, rows}};
    std::vector<std::pair<Table, std::size_t>> all;
    for (const Table table : row_tables) all.emplace_back(table, rows);
    all.emplace_back(Table::first_contacts, rows + 1);
    for (const Table table : contact_tables)
        if (bounces || table_infos()[static_cast<std::size_t>(table)].length != BufferLength::impacts)
            all.emplace_back(table, contacts);
    return all;
}

std::uint64_t fingerprint_of(const State& state) {
    std::vector<physics::BodyProperties> properties = state.properties;
    for (physics::BodyProperties& row : properties) row.flags &= ~physics::ROW_LARGE;  // depends on the settings
    std::uint64_t hash = hash_of(properties, 0);
    hash = hash_of(state.poses, hash);
    hash = hash_of(state.velocities, hash);
    return fingerprint_of(state, hash);
}

std::uint64_t fingerprint_of(const State& state, std::uint64_t hash_of_rows) {
    std::uint64_t hash = hash_of_rows;
    const auto add = [&](const auto&... tables) { ((hash = hash_of(tables, hash)), ...); };
    add(state.hulls, state.parts, state.fractures, state.pieces, state.tyres, state.way_points, state.surfaces, state.filters,
        state.exclusions);
    if (state.has_joints()) add(state.joints);
    if (state.fixed().vehicles) add(state.vehicles);
    if (!state.bonds.empty()) add(state.bonds);
    return hash;
}

std::uint64_t layout_of_tables() {
    std::uint64_t hash = 0;
    for (const TableInfo& info : table_infos()) hash = XXH64(info.name, std::strlen(info.name), hash + info.record_bytes);
    return hash;
}

void put_numbers(ByteWriter& out, const State& state, const physics::Parameters& parameters, const physics::Counts& counts,
                 bool rows_bounce) {
    out.put(portable(parameters));
    out.put(portable(counts));
    out.put(static_cast<std::int32_t>(state.substeps));
    out.put(state.body_count);
    out.put(rows_bounce);
    out.put_list(std::span(state.is_share() ? std::vector<std::uint32_t>() : state.rows()));
    out.put_list(std::span(state.joint_records));
}

void put_shapes(ByteWriter& out, const State& state, const StartLengths& at_start) {
    out.put_list(std::span(state.joints));
    out.put_list(std::span<const physics::JointBlock>(portable(state.joint_blocks)));
    out.put_list(std::span<const physics::BlockBody>(portable(state.block_bodies)));
    out.put_list(std::span(state.vehicles));
#define SCREE_PUT(name) out.put_list(behind(state.name, at_start.of(Table::name)));
    SCREE_EDITED_OF_SHAPES(SCREE_PUT)
#undef SCREE_PUT
}

void put_state(ByteWriter& out, const State& state, const StartLengths& at_start, SteppedTables which) {
    put_numbers(out, state, state.fixed(), state.counted(), state.rows_bounce());
    const auto stepped = stepped_tables(state.fixed().bodies, state.counted().contacts, state.bounces(), which);
    std::size_t bytes = 0;
    for (const auto& [table, count] : stepped) bytes += count * record_bytes(table);
    out.reserve(bytes + bytes / 16);
    for (const auto& [table, count] : stepped) out.put_bytes(records_of(state, table, count));
    put_shapes(out, state, at_start);
}

StateBytes::StateBytes(ByteReader& in, const State& own, const StartLengths& at_start, SteppedTables which)
    : parameters_(in.take<physics::Parameters>()),
      counts_(in.take<physics::Counts>()),
      substeps_(in.take<std::int32_t>()),
      body_count_(in.take<std::uint32_t>()),
      rows_bounce_(in.take<bool>()),
      rows_(in.take_list<std::uint32_t>()),
      joint_records_(in.take_list<std::uint32_t>()),
      at_start_(at_start),
      which_(which) {
    const std::size_t rows = parameters_.bodies;
    for (const auto& [table, count] :
         stepped_tables(rows, counts_.contacts, rows_bounce_ || parameters_.least_restitution > 0, which))
        tables_.emplace_back(table, in.take_bytes(count * record_bytes(table)));
#define SCREE_TAKE(name) edited_.name = in.take_records(sizeof(physics::records::name));
    SCREE_EDITED_OF_JOINTS(SCREE_TAKE)
    SCREE_EDITED_OF_SHAPES(SCREE_TAKE)
#undef SCREE_TAKE
    const auto in_range = [](const auto& list, std::size_t end) {
        return std::all_of(list.begin(), list.end(), [&](std::uint32_t one) { return one < end; });
    };
    if (body_count_ > parameters_.first_part || parameters_.first_part > rows ||
        rows - parameters_.first_part != edited_.parts.size() ||
        (edited_.filters.size() != 0 && edited_.filters.size() != rows) || (!rows_.empty() && rows_.size() != body_count_) ||
        !in_range(rows_, parameters_.first_part) || !in_range(joint_records_, edited_.joints.size()) ||
        parameters_.joint_blocks > edited_.joint_blocks.size() || parameters_.vehicles > edited_.vehicles.size() ||
        substeps_ < 1 || edited_.births.size() != (physics::has_copies(parameters_) ? parameters_.copies : 0) ||
        (edited_.gravities.size() != 0 && edited_.gravities.size() != parameters_.copies))
        refuse();
    if (which == SteppedTables::all) check(own);
}

void StateBytes::check(const State& own) const {
    const auto bytes = [&](Table table) {
        return std::find_if(tables_.begin(), tables_.end(), [&](const auto& one) { return one.first == table; })->second;
    };
    SavedTables saved{edited_, parameters_, counts_, body_count_, rows_, at_start_};
    saved.properties = bytes(Table::properties);
    saved.poses = bytes(Table::poses);
    saved.velocities = bytes(Table::velocities);
    saved.first_contacts = bytes(Table::first_contacts);
    saved.contacts = bytes(Table::contacts);
    check_tables(saved, own);
}

bool StateBytes::follow_from(const Settings& settings, vec3 gravity) const {
    const physics::Parameters expected = tuned(parameters_, gravity, settings);
    return std::memcmp(&expected, &parameters_, sizeof expected) == 0 && substeps_ == settings.substeps;
}

TableRanges StateBytes::restore(State& state) const {
    const physics::Parameters own = state.fixed();
    physics::Parameters& p = state.fixed();
    p = parameters_;
    p.group_size = own.group_size;
    p.group_shift = own.group_shift;
    p.most_groups = own.most_groups;
    p.pair_capacity = own.pair_capacity;
    p.contact_capacity = std::max(own.contact_capacity, State::with_reserve(counts_.contacts));
    state.counted() = physics::emptied(counts_, p);
    state.counted().contacts = counts_.contacts;
    state.substeps = substeps_;
    state.body_count = body_count_;
    state.joint_records = joint_records_;
#define SCREE_ASSIGN(name) assign(state.name, edited_.name.bytes(), at_start_.of(Table::name));
    SCREE_EDITED_OF_JOINTS(SCREE_ASSIGN)
    SCREE_EDITED_OF_SHAPES(SCREE_ASSIGN)
#undef SCREE_ASSIGN
    if (!have_groups(state.joint_groups, state.joints, state.joint_blocks, p.joint_blocks))
        state.joint_groups = joint_groups(state.joints, state.joint_blocks, p.joint_blocks);
    for (const auto& [table, count] : stepped_tables(0, 0, false, SteppedTables::all)) state.make(table);
    state.allocate();
    std::span<const std::byte> impacts;
    for (const auto& [table, bytes] : tables_) {
        if (table == Table::impacts)
            impacts = bytes;
        else if (!bytes.empty())
            std::memcpy(state.raw(table).data(), bytes.data(), bytes.size());
    }
    state.take_rows(rows_, rows_bounce_);
    if (which_ == SteppedTables::all) {
        state.clear_impacts();
        if (!impacts.empty()) std::memcpy(state.impacts.data(), impacts.data(), impacts.size());
    }
    state.index_surfaces();
    TableRanges changed = which_ == SteppedTables::all ? lasting_ranges(state) : TableRanges{};
    changed.push_back({Table::counts, 0, 1});
    changed.push_back({Table::ids, 0, p.bodies});
    append(changed, joint_structure_ranges(state));
#define SCREE_ADD(name)                                                                 \
    if (const std::size_t first = at_start_.of(Table::name); state.name.size() > first) \
        changed.push_back({Table::name, first, state.name.size() - first});
    SCREE_EDITED_OF_SHAPES(SCREE_ADD)
#undef SCREE_ADD
    return changed;
}

}  // namespace scree
