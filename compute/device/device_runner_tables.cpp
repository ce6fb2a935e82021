// Where the tables are on the device, and how they travel between it and a state.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>

#include "compute/device/device_runner.h"

namespace scree {

namespace {

std::string what_would_fit(const State& state, const host::DeviceReport& device) {
    // A body brings its parts and the pieces that it may break into: all have rows.
    const auto pieces = static_cast<std::size_t>(std::count_if(
        state.traits.begin(), state.traits.end(), [](const physics::Traits& t) { return t.motion == physics::MOTION_UNBORN; }));
    const std::size_t parts = state.fixed().bodies - state.fixed().first_part;
    const auto bodies = static_cast<double>(state.fixed().first_part - pieces);
    const double needed = static_cast<double>(state.bytes()), memory = static_cast<double>(device.memory_bytes);
    std::string with;
    if (pieces > 0) with += ", with the " + std::to_string(pieces) + " pieces that they may break into,";
    if (parts > 0) with += ", with their " + std::to_string(parts) + " parts,";
    char text[160];
    std::snprintf(text, sizeof text, " take %.3g GB, %s has %.3g: about %.2g bodies like these would fit", needed / 1e9,
                  device.name.c_str(), memory / 1e9, std::min(bodies, bodies * memory / needed));
    return "All tables of the " + std::to_string(state.fixed().first_part - pieces) + " bodies" + with + text;
}

}  // namespace

void DeviceRunner::make_buffers() {
    const std::uint32_t most_groups = device_->limits().maxComputeWorkGroupCount[0];
    const physics::Parameters& p = state_->fixed();
    if (std::max({p.pair_capacity, p.buckets, p.contact_capacity}) / p.group_size >= most_groups)
        throw host::DeviceError("the scene needs lists of " + std::to_string(std::max(p.pair_capacity, p.buckets)) +
                                " items, but this device runs at most " +
                                std::to_string(std::uint64_t{most_groups} * p.group_size) +
                                " threads at once: use fewer bodies, or --backend cpu");
    places_ = table_places(*state_);
    buffers_.resize(buffer_count);
    for (std::size_t i = 0; i < buffer_count; ++i) {
        if (buffers_[i].bytes() == places_.bytes[i]) continue;
        buffers_[i] = {};  // its memory first, then the new one's
        try {
            buffers_[i] = host::Buffer(device_, buffer_infos()[i].name, places_.bytes[i]);
        } catch (const host::DeviceError& error) {
            throw host::DeviceError(std::string(error.what()) + ". " + what_would_fit(*state_, device_->report()));
        }
    }
}

void DeviceRunner::upload() {
    using enum Table;
    parity_ = 0;
    const auto send = [&](Table table) { write(table, state_->raw(table)); };
    for (const Table table : {parameters, counts, traits, poses, velocities, rests, strains, hulls, parts, fractures, pieces,
                              tyres, way_points, joints, vehicles, ids})
        send(table);
    sent_ = state_->fixed();
    // Before the first step, and for tables that were never brought back, zeros are right.
    for (const Table table : {masses, contacts, contacts_before, impulses, impulses_before, first_contacts})
        if (!state_->raw(table).empty()) send(table);
}

void DeviceRunner::send_inputs() {
    const physics::Parameters& p = state_->fixed();
    if (std::memcmp(&p, &sent_, sizeof p) != 0) {
        buffer(Table::parameters).write(&p, sizeof p);
        sent_ = p;
    }
    if (p.actions) buffer(Table::actions).write(state_->actions.data(), p.actions * sizeof(physics::Action));
}

void DeviceRunner::read(Table table, std::span<std::byte> bytes, std::size_t offset) const {
    buffer(table).read(bytes.data(), bytes.size(), places_.begin[static_cast<std::size_t>(table)] + offset);
}

void DeviceRunner::write(Table table, std::span<const std::byte> bytes) {
    if (!bytes.empty()) buffer(table).write(bytes.data(), bytes.size(), places_.begin[static_cast<std::size_t>(table)]);
}

DeviceRunner::Range DeviceRunner::range(Table table) const {
    const TableInfo& info = table_infos()[static_cast<std::size_t>(table)];
    return {&buffer(table), places_.begin[static_cast<std::size_t>(table)], state_->allocated(info.length) * info.record_bytes};
}

void DeviceRunner::poison() {
    using enum Table;
    const auto lasting = {parameters, counts, traits,    poses,   velocities,      rests,           strains,
                          hulls,      parts,  fractures, pieces,  tyres,           way_points,      joints,
                          vehicles,   ids,    masses,    actions, contacts_before, impulses_before, first_contacts};
    for (std::size_t i = 0; i < table_count; ++i) {
        const auto table = static_cast<Table>(i);
        if (std::find(lasting.begin(), lasting.end(), table) != lasting.end()) continue;
        const std::vector<std::byte> garbage(range(table).bytes, std::byte{0xCD});
        write(table, garbage);
    }
}

void DeviceRunner::fetch_body(std::size_t index) {
    for (const Table table : {Table::traits, Table::poses, Table::velocities, Table::rests}) {
        const std::size_t bytes = table_infos()[static_cast<std::size_t>(table)].record_bytes;
        read(table, state_->raw(table).subspan(index * bytes, bytes), index * bytes);
    }
}

void DeviceRunner::fetch_bodies() {
    for (const Table table : {Table::counts, Table::poses, Table::velocities, Table::rests}) read(table, state_->raw(table));
    if (planned_content_.breaking) read(Table::traits, state_->raw(Table::traits));  // who is there
}

void DeviceRunner::fetch_contacts() {
    for (const Table table : {Table::contacts, Table::impulses, Table::constraints}) fetch_live(table);
    if (planned_content_.reordered) fetch_live(Table::first_contacts);  // contacts_by_id
    if (planned_content_.convex) fetch_live(Table::pairs);              // whose hulls traffic_of counts
}

std::uint32_t DeviceRunner::joint_records() const {
    return state_->has_joints() ? static_cast<std::uint32_t>(state_->joints.size()) : 0;
}

void DeviceRunner::fetch_joints() {
    if (state_->has_joints()) read(Table::joints, state_->raw(Table::joints));
}

void DeviceRunner::fetch_vehicles() {
    if (planned_content_.vehicles) read(Table::vehicles, state_->raw(Table::vehicles));
}

void DeviceRunner::send_vehicle(std::size_t index) {
    constexpr std::size_t first = offsetof(physics::Handling, throttle);
    constexpr std::size_t bytes = offsetof(physics::Handling, next) - first;
    buffer(Table::vehicles).write(&state_->vehicles[index].handling.throttle, bytes, index * sizeof(physics::Vehicle) + first);
}

void DeviceRunner::send_joint(std::size_t record) {
    const physics::Joint& joint = state_->joints[record];
    buffer(Table::joints).write(joint.axes, sizeof joint.axes, record * sizeof joint + offsetof(physics::Joint, axes));
}

void DeviceRunner::fetch() {
    fetch_bodies();
    for (std::size_t i = 0; i < table_count; ++i) {
        const auto table = static_cast<Table>(i);
        const bool is_input = table == Table::parameters || table == Table::actions;
        if (table == Table::candidates || table == Table::scan_sums || is_input) continue;
        if (table == Table::contacts_before || table == Table::impulses_before) {
            state_->make(table);
            read(table, state_->raw(table));
        } else {
            fetch_live(table);
        }
    }
}

// The items that mean something at present. `counts` must be here already.
void DeviceRunner::fetch_live(Table table) {
    const TableInfo& info = table_infos()[static_cast<std::size_t>(table)];
    state_->make(table);
    const std::size_t items = state_->live(info.length);
    if (items) read(table, state_->raw(table).first(items * info.record_bytes));
}

}  // namespace scree
