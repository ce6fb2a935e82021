// Device runner: bodies change rows in its own tables.
#include <algorithm>
#include <cstddef>

#include "compute/device/device_runner.h"

namespace scree {

namespace {

constexpr std::size_t words_to(std::size_t bytes) {
    return bytes / sizeof(std::uint32_t);
}

}  // namespace

RowMover::Records DeviceRunner::records_of(Table table, std::size_t count) const {
    const Range place = range(table);
    const TableInfo& info = table_infos()[static_cast<std::size_t>(table)];
    return {place.buffer, words_to(place.offset), words_to(info.record_bytes), count, info.is_grouped};
}

RowMover::Tables DeviceRunner::tables_to_move() const {
    const std::uint32_t rows = state_->fixed().bodies, bodies = state_->body_count;
    const std::size_t contacts = state_->counted().contacts;
    RowMover::Tables tables{rows, bodies, records_of(Table::first_contacts, rows + 1), {}, {}, {}};
    for (const Table table : row_tables) tables.of_bodies.push_back(records_of(table, bodies));
    const auto follow = [&](Table table, std::size_t count, std::size_t bytes) {
        if (count > 0) tables.with_rows.emplace_back(records_of(table, count), words_to(bytes));
    };
    follow(Table::properties, rows, offsetof(physics::BodyProperties, owner));
    follow(Table::contacts, contacts, offsetof(physics::Contact, a));
    follow(Table::contacts, contacts, offsetof(physics::Contact, b));
    follow(Table::joints, joint_records(), offsetof(physics::Joint, a));
    follow(Table::joints, joint_records(), offsetof(physics::Joint, b));
    follow(Table::block_bodies, joint_records() > 0 ? state_->block_bodies.size() : 0, offsetof(physics::BlockBody, body));
    follow(Table::bonds, state_->bonds.size(), offsetof(physics::Bond, a));
    follow(Table::bonds, state_->bonds.size(), offsetof(physics::Bond, b));
    const std::size_t vehicles = state_->fixed().vehicles;
    follow(Table::vehicles, vehicles, offsetof(physics::Vehicle, dynamics) + offsetof(physics::VehicleDynamics, chassis));
    for (std::size_t k = 0; k < physics::MOST_WHEELS; ++k)
        follow(Table::vehicles, vehicles,
               offsetof(physics::Vehicle, wheel) + k * sizeof(physics::VehicleWheel) + offsetof(physics::VehicleWheel, body));
    const auto take_along = [&](Table now, Table before) {
        const std::size_t count = state_->live(table_infos()[static_cast<std::size_t>(now)].length);
        if (count > 0) tables.of_contacts.emplace_back(records_of(now, count), &buffer(before));
    };
    for (const Table table : contact_tables) take_along(table, other_parity(table));
    return tables;
}

bool DeviceRunner::prepare_to_move(std::span<const std::uint32_t> from) {
    wait_for_returned();
    try {
        if (!mover_) mover_ = std::make_unique<RowMover>(device_, group_size());
        mover_->prepare(tables_to_move(), from);
        return true;
    } catch (const host::DeviceLost&) {
        throw;
    } catch (const host::DeviceError&) {  // short of memory, or a table is longer than a binding
        mover_.reset();
        return false;
    }
}

void DeviceRunner::move_rows() {
    mover_->move();
    parity_ ^= 1;  // the contacts of the last step are in the other tables now
}

}  // namespace scree
