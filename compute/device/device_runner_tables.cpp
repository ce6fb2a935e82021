// Device runner: buffers of the tables and transfers.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <set>
#include <stdexcept>

#include "compute/device/device_runner.h"
#include "compute/device/record_groups.h"
#include "host/vulkan/transfer.h"
#include "shaders/physics/base/work_counts.h"

namespace scree {

namespace {

std::string what_would_fit(const State& state, const host::DeviceReport& device) {
    // A body adds rows for its parts and fragments.
    const auto pieces = static_cast<std::size_t>(
        std::count_if(state.properties.begin(), state.properties.begin() + state.body_count,
                      [](const physics::BodyProperties& t) { return t.motion == physics::MOTION_PENDING; }));
    const std::size_t parts = state.fixed().bodies - state.fixed().first_part;
    const auto bodies = static_cast<double>(state.body_count - pieces);
    const double needed = static_cast<double>(state.bytes()), memory = static_cast<double>(device.memory_bytes);
    const TableOffsets tables = table_offsets(state);
    const double longest = static_cast<double>(*std::max_element(tables.bytes.begin(), tables.bytes.end()));
    const double fitting = std::min(memory / needed, static_cast<double>(device.largest_buffer) / longest);
    std::string with;
    if (pieces > 0) with += ", with the " + std::to_string(pieces) + " pieces that they may break into,";
    if (parts > 0) with += ", with their " + std::to_string(parts) + " parts,";
    char text[160];
    std::snprintf(text, sizeof text, " take %.3g GB, %s has %.3g: about %.2g bodies like these would fit", needed / 1e9,
                  device.name.c_str(), memory / 1e9, std::min(bodies, bodies * fitting));
    return "All tables of the " + std::to_string(state.body_count - pieces) + " bodies" + with + text;
}

// Whether a table's contents last to the next step, or to the repetition of an aborted one.
bool lasts(Table table) {
    const std::vector<Table>& lasting = lasting_tables();
    return std::any_of(lasting.begin(), lasting.end(), [&](Table one) { return one == table || other_parity(one) == table; });
}

// Whether a binding has a buffer of its own.
bool holds_tables(std::size_t buffer) {
    for (std::size_t i = 0; i < table_count; ++i)
        if (buffer_of(static_cast<Table>(i)) == buffer) return true;
    return false;
}

// The same for any table of a buffer.
bool lasts(std::size_t buffer) {
    for (std::size_t i = 0; i < table_count; ++i)
        if (buffer_of(static_cast<Table>(i)) == buffer && lasts(static_cast<Table>(i))) return true;
    return false;
}

bool is_grouped(Table table) {
    return table_infos()[static_cast<std::size_t>(table)].is_grouped;
}
// Length in groups of bytes of a grouped table, which must begin with its first record.
std::size_t require_groups(Table table, std::size_t offset, std::size_t bytes) {
    if (offset != 0)
        throw std::logic_error(std::string("only the first records of the table ") +
                               table_infos()[static_cast<std::size_t>(table)].name + " travel, which is in groups on a device");
    return bytes_in_groups(bytes / record_bytes(table), record_bytes(table));
}

// Copies the layout of the tables in one buffer.
void take_offsets(TableOffsets& offsets, const TableOffsets& wanted, std::size_t buffer) {
    offsets.bytes[buffer] = wanted.bytes[buffer];
    for (std::size_t i = 0; i < table_count; ++i) {
        if (buffer_of(static_cast<Table>(i)) != buffer) continue;
        offsets.begin[i] = wanted.begin[i];
        offsets.room[i] = wanted.room[i];
    }
}

// Spare records of a table: half as many again for those that edits extend one by one. Lists have their own reserve
// (State::grow).
std::size_t room_behind(const State& state, BufferLength length) {
    switch (length) {
        case BufferLength::bodies:
        case BufferLength::entries:
        case BufferLength::bodies_and_end:
        case BufferLength::hulls:
        case BufferLength::parts:
        case BufferLength::fractures:
        case BufferLength::pieces:
        case BufferLength::tyres:
        case BufferLength::surfaces:
        case BufferLength::immersions:
        case BufferLength::filters:
        case BufferLength::exclusions:
        case BufferLength::joints:
        case BufferLength::joint_blocks:
        case BufferLength::block_bodies:
        case BufferLength::vehicles:
            return 16 + state.allocated(length) / 2;
        case BufferLength::slots:
            return 16 + state.block_bodies.size() / 2;
        default:
            return 0;
    }
}

}  // namespace

void DeviceRunner::make_buffers() {
    const auto& most_groups = device_->limits().maxComputeWorkGroupCount;
    physics::Parameters& p = state_->fixed();
    p.most_groups = most_groups[0];
    const std::uint32_t longest = std::max({p.pair_capacity, physics::buckets_in_all(p) + 1, p.contact_capacity});
    if (physics::work_for(longest, p).y > most_groups[1])
        throw host::DeviceError("the scene needs lists of " + std::to_string(longest) + " items, but this device runs at most " +
                                std::to_string(std::uint64_t{most_groups[0]} * most_groups[1] * p.group_size) +
                                " threads at once: use fewer bodies, or --backend cpu");
    buffers_.resize(buffer_count);
    for (std::size_t i = 0; i < buffer_count; ++i)
        if (holds_tables(i) && (!buffers_[i] || !have_room(offsets_, i, *state_))) make_buffer(i);
    tell_offsets(offsets_, state_->fixed());
}

// Reallocates a buffer for a table that an edit extended, with spare room if memory allows, keeping lasting contents.
void DeviceRunner::make_buffer(std::size_t index) {
    const TableOffsets were = offsets_;
    host::Buffer before = std::move(buffers_[index]);
    const bool keeps = before && lasts(index);
    const TableOffsets exact = table_offsets(*state_),
                       roomy = table_offsets(*state_, [&](BufferLength length) { return room_behind(*state_, length); });
    const bool with_room = before && roomy.bytes[index] <= device_->report().largest_binding;
    if (!keeps) before = {};  // freed before the new one is allocated
    const auto make = [&](const TableOffsets& wanted) {
        buffers_[index] = host::Buffer(device_, buffer_infos()[index].name, wanted.bytes[index]);
        take_offsets(offsets_, wanted, index);
    };
    try {
        make(with_room ? roomy : exact);
    } catch (const host::DeviceError&) {
        try {
            make(exact);
        } catch (const host::DeviceError& error) {
            buffers_[index] = std::move(before);
            throw host::DeviceError(std::string(error.what()) + ". " + what_would_fit(*state_, device_->report()));
        }
    }
    if (keeps) move_lasting(before, were, index);
    ++buffers_made_;
}

void DeviceRunner::move_lasting(const host::Buffer& before, const TableOffsets& were, std::size_t index) {
    host::CommandBuffer commands(device_);
    for (std::size_t i = 0; i < table_count; ++i) {
        const std::size_t bytes = std::min(were.room[i], offsets_.room[i]);
        if (buffer_of(static_cast<Table>(i)) == index && lasts(static_cast<Table>(i)) && bytes > 0)
            commands.copy(before, buffers_[index], bytes, were.begin[i], offsets_.begin[i]);
    }
    commands.end();
    device_->submit_and_wait({commands.handle()});
}

void DeviceRunner::upload_all() {
    parity_ = 0;
    // Also tables that last under their other name. Tables never downloaded, and all before the first step, are zero.
    std::set<Table> lasting;
    for (const Table table : lasting_tables()) lasting.insert({table, other_parity(table)});
    TableRanges all;
    for (const Table table : lasting) all.push_back({table, 0, state_->raw(table).size() / record_bytes(table)});
    upload(all);
    sent_ = state_->fixed();
}

void DeviceRunner::send_parameters() {
    const physics::Parameters& p = state_->fixed();
    if (std::memcmp(&p, &sent_, sizeof p) == 0) return;
    const host::Upload piece{std::as_bytes(std::span(&p, 1)), &buffer(Table::parameters)};
    transfer_.upload({&piece, 1});
    sent_ = p;
}

void DeviceRunner::give_inputs() {
    const physics::Parameters& p = state_->fixed();
    if (std::memcmp(&p, &sent_, sizeof p) == 0 && p.actions == 0) return;
    inputs_->give(parity_, p, std::span(state_->actions).first(p.actions));
    sent_ = p;
    inputs_given_ = true;
}

// Bytes of tables as the host has them, at an offset in them.
struct DeviceRunner::Piece {
    Table table;
    std::size_t offset;
    std::span<std::byte> bytes;
};
struct DeviceRunner::ConstPiece {
    Table table;
    std::size_t offset;
    std::span<const std::byte> bytes;
};

void DeviceRunner::fetch(std::span<const Piece> pieces) const {
    std::vector<host::Download> downloads;
    std::vector<std::vector<std::byte>> groups(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto& [table, offset, bytes] = pieces[i];
        if (is_grouped(table)) groups[i].resize(require_groups(table, offset, bytes.size()));
        downloads.push_back({is_grouped(table) ? std::span(groups[i]) : bytes, &buffer(table), range(table).offset + offset});
    }
    transfer_.download(downloads);
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (is_grouped(pieces[i].table)) from_groups(groups[i], record_bytes(pieces[i].table), pieces[i].bytes);
}

void DeviceRunner::store(std::span<const ConstPiece> pieces) {
    std::vector<host::Upload> uploads;
    std::vector<std::vector<std::byte>> groups(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const auto& [table, offset, bytes] = pieces[i];
        if (is_grouped(table)) {
            groups[i].resize(require_groups(table, offset, bytes.size()));
            to_groups(bytes, record_bytes(table), groups[i]);
        }
        uploads.push_back(
            {is_grouped(table) ? std::span<const std::byte>(groups[i]) : bytes, &buffer(table), range(table).offset + offset});
    }
    transfer_.upload(uploads);
}

void DeviceRunner::read(Table table, std::span<std::byte> bytes, std::size_t offset) const {
    fetch(std::array{Piece{table, offset, bytes}});
}

void DeviceRunner::read(const Contents& contents) const {
    std::vector<Piece> pieces;
    for (const auto& [table, bytes] : contents) pieces.push_back({table, 0, bytes});
    fetch(pieces);
}

void DeviceRunner::write(Table table, std::span<const std::byte> bytes) {
    store(std::array{ConstPiece{table, 0, bytes}});
}

DeviceRunner::Range DeviceRunner::range(Table table) const {
    const auto place = static_cast<std::size_t>(table);
    return {&buffer(table), offsets_.begin[place], offsets_.room[place]};
}

void DeviceRunner::poison() {
    const std::vector<Table>& lasting = lasting_tables();
    host::CommandBuffer commands(device_);
    for (std::size_t i = 0; i < table_count; ++i) {
        const auto table = static_cast<Table>(i);
        const auto is_in_its_memory = [&](Table one) { return share_memory(one, table); };
        if (std::any_of(lasting.begin(), lasting.end(), is_in_its_memory)) continue;
        const auto [buffer, offset, bytes] = range(table);
        commands.fill(*buffer, 0xCDCDCDCD, bytes, offset);
        commands.barrier();  // the next table may share this memory
    }
    commands.end();
    device_->submit_and_wait({commands.handle()});
}

void DeviceRunner::send(const TableRanges& ranges) {
    wait_for_returned();
    std::vector<ConstPiece> pieces;
    for (const TableRange& range : ranges) {
        const std::size_t bytes = record_bytes(range.table);
        pieces.push_back({range.table, range.first * bytes,
                          std::as_const(*state_).raw(range.table).subspan(range.first * bytes, range.count * bytes)});
    }
    store(pieces);
}

void DeviceRunner::receive(const TableRanges& ranges) {
    std::vector<Piece> pieces;
    for (const TableRange& range : ranges) {
        const std::size_t bytes = record_bytes(range.table);
        if (state_->raw(range.table).size() < (range.first + range.count) * bytes) state_->make(range.table);
        pieces.push_back(
            {range.table, range.first * bytes, state_->raw(range.table).subspan(range.first * bytes, range.count * bytes)});
    }
    fetch(pieces);
}

void DeviceRunner::keep(std::size_t slot, const TableRanges& ranges) {
    Kept& kept = kept_[slot];
    kept.ranges = ranges;
    kept.buffers.resize(ranges.size());
    host::CommandBuffer commands(device_);
    commands.barrier();
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const auto [from, offset, bytes] = place_of(ranges[i]);
        if (bytes == 0) continue;
        if (kept.buffers[i].bytes() < bytes) {
            kept.buffers[i] = {};
            kept.buffers[i] = host::Buffer(device_, "kept state", bytes + bytes / 8);
        }
        commands.copy(*from, kept.buffers[i], bytes, offset, 0);
    }
    commands.end();
    device_->submit_and_wait({commands.handle()});
}

void DeviceRunner::bring_back(std::size_t slot) {
    wait_for_returned();
    const Kept& kept = kept_.at(slot);
    tell_offsets(offsets_, state_->fixed());  // which kept parameters are without
    host::CommandBuffer commands(device_);
    commands.barrier();
    for (std::size_t i = 0; i < kept.ranges.size(); ++i) {
        const auto [to, offset, bytes] = place_of(kept.ranges[i]);
        if (bytes > 0) commands.copy(kept.buffers[i], *to, bytes, 0, offset);
    }
    commands.end();
    device_->submit_and_wait({commands.handle()});
}

DeviceRunner::Range DeviceRunner::place_of(const TableRange& range) const {
    const std::size_t bytes = record_bytes(range.table);
    const std::size_t length =
        is_grouped(range.table) ? require_groups(range.table, range.first * bytes, range.count * bytes) : range.count * bytes;
    return {&buffer(range.table), this->range(range.table).offset + range.first * bytes, length};
}

std::uint32_t DeviceRunner::joint_records() const {
    return state_->has_joints() ? static_cast<std::uint32_t>(state_->joints.size()) : 0;
}

}  // namespace scree
