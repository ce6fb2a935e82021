// Gathering the tables of all ranks.
#include "compute/distributed/gathering.h"

#include <algorithm>
#include <array>

#include "compute/distributed/ownership.h"
#include "compute/distributed/packing.h"
#include "compute/tables/table_layout.h"

namespace scree {

namespace {

struct TracedContact {
    OwnedContact contact;
    float carried = 0;
};

// The records of owned rows in a range of a table of bodies.
void gather_rows(State& state, Exchange& exchange, const TableRange& range) {
    const std::size_t bytes = record_bytes(range.table);
    const std::span<std::byte> table = state.raw(range.table);
    const std::size_t last = std::min(range.first + range.count, table.size() / bytes);
    Bytes sent;
    for (std::size_t row = range.first; row < last; ++row) {
        if (!state.is_owned(row)) continue;
        put(sent, static_cast<std::uint32_t>(row));
        sent.insert(sent.end(), table.begin() + static_cast<std::ptrdiff_t>(row * bytes),
                    table.begin() + static_cast<std::ptrdiff_t>((row + 1) * bytes));
    }
    for (const Bytes& received : exchange.all_gather(sent))
        for (std::size_t at = 0; at < received.size(); at += sizeof(std::uint32_t) + bytes) {
            std::uint32_t row = 0;
            std::memcpy(&row, &received[at], sizeof row);
            std::memcpy(&table[row * bytes], &received[at + sizeof row], bytes);
        }
}

void gather_contacts(State& state, Exchange& exchange) {
    Bytes sent;
    for (std::uint32_t row = 0; row < state.fixed().bodies; ++row)
        for (std::uint32_t k = state.first_contacts[row]; k < state.first_contacts[row + 1]; ++k)
            if (state.owns_contact(state.contacts[k]))
                put(sent, TracedContact{{row, ContactRecords::of(state, k)}, k < state.carried.size() ? state.carried[k] : 0.0f});
    std::vector<TracedContact> all;
    for (const Bytes& received : exchange.all_gather(sent))
        for (Unpacker from(received); from.has_more();) all.push_back(from.take<TracedContact>());
    const auto key = [&](const TracedContact& one) {
        const OwnedContact& c = one.contact;
        const physics::Contact& contact = c.records.contacts;
        return std::pair(c.owner, state.id_of(contact.a == c.owner ? contact.b : contact.a));
    };
    std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    std::vector<OwnedContact> contacts;
    contacts.reserve(all.size());
    for (const TracedContact& one : all) contacts.push_back(one.contact);
    merge_contacts(state, contacts, [](const physics::Contact&) { return false; });
    for (std::size_t k = 0; k < std::min(all.size(), state.carried.size()); ++k) state.carried[k] = all[k].carried;
}

void gather_joints(State& state, Exchange& exchange) {
    Bytes sent;
    for (std::uint32_t i = 0; i < state.fixed().joint_blocks; ++i) {
        const physics::JointBlock& block = state.joint_blocks[i];
        if (!state.owns_block(block)) continue;
        for (std::uint32_t k = block.first_joint; k < block.first_joint + block.joints; ++k) {
            put(sent, k);
            put(sent, state.joints[k]);
        }
    }
    for (const Bytes& received : exchange.all_gather(sent))
        for (Unpacker from(received); from.has_more();) {
            const auto k = from.take<std::uint32_t>();
            from.take(state.joints[k]);
        }
}

void gather_vehicles(State& state, Exchange& exchange) {
    Bytes sent;
    for (std::uint32_t i = 0; i < state.fixed().vehicles; ++i) {
        if (!state.is_owned(state.vehicles[i].dynamics.chassis)) continue;
        put(sent, i);
        put(sent, state.vehicles[i]);
    }
    for (const Bytes& received : exchange.all_gather(sent))
        for (Unpacker from(received); from.has_more();) {
            const auto i = from.take<std::uint32_t>();
            from.take(state.vehicles[i]);
        }
}

}  // namespace

void gather_ranges(State& state, Exchange& exchange, const TableRanges& ranges) {
    if (exchange.ranks() == 1 || state.presence.empty()) return;
    bool any_contacts = false, any_joints = false, any_vehicles = false;
    for (const TableRange& range : ranges) {
        // Others are the same on all ranks, or of no use between steps.
        const std::vector<Table>& of_owners = tables_of_owners();
        if (std::find(of_owners.begin(), of_owners.end(), range.table) != of_owners.end()) gather_rows(state, exchange, range);
        any_contacts |= is_of_contacts(range.table);
        any_joints |= range.table == Table::joints;
        any_vehicles |= range.table == Table::vehicles;
    }
    if (any_contacts) gather_contacts(state, exchange);
    if (any_joints) gather_joints(state, exchange);
    if (any_vehicles) gather_vehicles(state, exchange);
}

}  // namespace scree
