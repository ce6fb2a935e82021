// What ranks exchange between the stages of a step.
#include <algorithm>
#include <span>

#include "compute/distributed/distributed_runner.h"
#include "compute/distributed/packing.h"
#include "compute/plan/stage_slices.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

struct BrokenBody {
    std::uint32_t row = 0;
    physics::Pose pose;
    physics::Velocity velocity;
};

// At the start of a step.
const std::vector<Table>& tables_at_start() {
    static const std::vector<Table> all = [] {
        std::vector<Table> tables = tables_of_ghosts();
        tables.push_back(Table::forces);
        return tables;
    }();
    return all;
}

}  // namespace

bool DistributedRunner::sync(SyncPoint at) {
    if (at == SyncPoint::none) return true;
    const TimedSlice slice(timeline(), "exchange");
    return exchange_at(at);
}

bool DistributedRunner::exchange_at(SyncPoint at) {
    using enum Table;
    using Rows = DeviceSide::Rows;
    if (exchange_->ranks() == 1) {
        if (at != SyncPoint::room) return true;
        device_.fetch_counts();
        return state_->counted().overflow == 0;
    }
    const bool fast = state_->counted().fast != 0;
    switch (at) {
        case SyncPoint::none:
            break;
        case SyncPoint::ghosts:
            device_.fetch(tables_at_start());
            device_.fetch_contacts_of_sleepers();
            if (device_) share_.before_change = [&] { device_.fetch_for_new_rows(); };
            halo_.find(*state_, ownership_, *exchange_, share_);
            share_.before_change = nullptr;
            if (const Share::Changes changes = share_.changes(); changes.any()) device_.store_new_rows(changes);
            device_.take_rows(halo_);
            device_.mark_presence();
            device_.store(tables_at_start(), Rows::ghosts);
            break;
        case SyncPoint::flags:
            device_.fetch_counts();
            device_.fetch({masses}, Rows::ghosts);  // as the stage has found them
            sync_flags();
            device_.store_counts();
            break;
        case SyncPoint::room:
            device_.fetch_counts();
            return sync_room();
        case SyncPoint::struck:
            if (!fast) break;
            device_.fetch({bounds});
            halo_.send_struck(*state_, *exchange_);
            device_.store({bounds});
            break;
        case SyncPoint::wake:
            sync_wake();
            break;
        case SyncPoint::velocities:
            device_.fetch({velocities, masses}, Rows::sent);
            halo_.start_velocities(*state_, *exchange_);
            if (!device_) break;
            halo_.finish(*state_, *exchange_);
            device_.store({velocities, masses}, Rows::ghosts);
            break;
        case SyncPoint::motion:
            device_.fetch({velocities, poses, forces, impact_debts}, Rows::sent);
            halo_.start_motion(*state_, *exchange_);
            if (!device_) break;
            halo_.finish(*state_, *exchange_);
            device_.store({velocities, poses, forces, impact_debts, masses}, Rows::ghosts);
            break;
        case SyncPoint::ends:
            device_.fetch_counts();
            sync_ends();
            device_.store_counts();
            break;
        case SyncPoint::stops:
            if (!fast) break;
            device_.fetch({bounds}, Rows::sent);
            device_.fetch({bounds}, Rows::ghosts);
            halo_.send_stops(*state_, *exchange_);
            device_.store({bounds}, Rows::ghosts);
            break;
        case SyncPoint::kept: {
            device_.fetch_counts();
            std::uint32_t broken[1] = {state_->counted().broken};
            exchange_->add(broken);
            state_->counted().broken = broken[0];
            device_.store_counts();
            if (broken[0] == 0) break;
            device_.fetch({forces});
            halo_.send_kept(*state_, *exchange_);
            device_.store({forces}, Rows::ghosts);
            break;
        }
        case SyncPoint::broken:
            if (state_->counted().broken == 0) break;
            device_.fetch({forces, poses, velocities});
            sync_broken();
            device_.store({forces, poses, velocities});
            break;
    }
    return true;
}

void DistributedRunner::sync_flags() {
    physics::Counts& counts = state_->counted();
    std::uint32_t flags[5] = {counts.levels, counts.levels_stirring, counts.large_stirring, counts.sleepers, counts.fast};
    exchange_->unite(flags);
    counts.levels = flags[0];
    counts.levels_stirring = flags[1];
    counts.large_stirring = flags[2];
    counts.sleepers = flags[3];
    counts.fast = flags[4];
}

bool DistributedRunner::sync_room() {
    std::uint32_t overflow[1] = {state_->counted().overflow};
    exchange_->unite(overflow);
    return overflow[0] == 0;
}

// What is awake by then is known to all; without shaking bodies one round is enough.
void DistributedRunner::sync_wake() {
    using Rows = DeviceSide::Rows;
    physics::Counts& counts = state_->counted();
    if (!counts.sleepers || !physics::any_stirs(counts)) return;
    device_.fetch_counts();
    if (!knows_waking_) {
        physics::uint& work = counts.arguments[physics::WORK_WAKE].x;
        std::uint32_t some[1] = {work};
        exchange_->unite(some);
        knows_waking_ = true;
        wakes_ = some[0] != 0;
        // A CPU asks whether there is work; a device has as many threads for it as there are contacts here.
        if (wakes_ && device_)
            counts.arguments[physics::WORK_WAKE] = counts.arguments[physics::WORK_CONTACTS];
        else if (wakes_)
            work = std::max(1u, work);
        device_.store_counts();
    } else if (!wakes_) {
        return;
    }
    device_.fetch({Table::sleep_states}, Rows::sent);
    halo_.send_sleep_states(*state_, *exchange_);
    device_.store({Table::sleep_states}, Rows::ghosts);
}

void DistributedRunner::sync_ends() {
    physics::Counts& counts = state_->counted();
    std::uint32_t sums[3] = {counts.fast, counts.spin_limited - spin_limited_, counts.quarantined - quarantined_};
    exchange_->add(sums);
    counts.spin_limited = spin_limited_ + sums[1];
    counts.quarantined = quarantined_ + sums[2];
    if (sums[2] != 0) {
        device_.fetch({Table::properties, Table::masses, Table::velocities, Table::sleep_states});
        sync_quarantined();
        device_.store({Table::properties, Table::masses, Table::velocities, Table::sleep_states});
    }
    if (sums[0] == 0) return;
    counts.fast = 1;
    counts.arguments[physics::WORK_CCD_PAIRS] = counts.arguments[physics::WORK_PAIRS];
    using Rows = DeviceSide::Rows;
    device_.fetch({Table::poses, Table::bounds}, Rows::sent);
    device_.fetch({Table::poses, Table::bounds}, Rows::ghosts);
    halo_.send_ends(*state_, *exchange_);
    device_.store({Table::poses, Table::bounds}, Rows::ghosts);
}

void DistributedRunner::sync_quarantined() {
    State& state = *state_;
    Bytes sent;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        if (!state.is_owned(row) || !physics::is_quarantined(state.properties[row].motion) || state.masses[row].shares >= 0)
            continue;
        put(sent, state.id_of(row));
        put(sent, state.masses[row].shares);
    }
    sync_ownerless(/* breaks */ false);
    for (const Bytes& received : exchange_->all_gather(sent))
        for (Unpacker from(received); from.has_more();) {
            const std::uint32_t row = state.row_of(from.take<std::uint32_t>());
            const auto mark = from.take<float>();
            if (row == physics::NONE) continue;
            state.properties[row].motion = physics::MOTION_QUARANTINED;
            state.masses[row].shares = mark;
            state.velocities[row] = {};
            state.sleep_states[row] = 0;
        }
}

// Joints of blocks that lose their last body, and vehicles that lose their chassis: from then on every rank has them alike, and
// drives what is in quarantine alike, like whatever does not move. `breaks`: with bodies that break, which are known by then.
void DistributedRunner::sync_ownerless(bool breaks) {
    State& state = *state_;
    if (!state.has_joints() && state.fixed().vehicles == 0) return;
    const auto stays = [&](std::uint32_t row) {
        return state.is_owned(row) && !physics::is_quarantined(state.properties[row].motion) &&
               !(breaks && state.forces[row].kept < 1);
    };
    TableRanges lost;
    for (std::uint32_t i = 0; i < state.fixed().joint_blocks; ++i) {
        const physics::JointBlock& block = state.joint_blocks[i];
        const std::span members = std::span(state.block_bodies).subspan(block.first_body, block.bodies);
        if (state.owns_block(block) && std::none_of(members.begin(), members.end(), [&](const auto& m) { return stays(m.body); }))
            lost.push_back({Table::joints, block.first_joint, block.joints});
    }
    for (std::uint32_t i = 0; i < state.fixed().vehicles; ++i) {
        const std::uint32_t chassis = state.vehicles[i].dynamics.chassis;
        if (state.is_owned(chassis) && !stays(chassis)) lost.push_back({Table::vehicles, i, 1});
    }
    device_.fetch(lost);
    Bytes sent;
    for (const TableRange& range : lost)
        for (std::size_t k = range.first; k < range.first + range.count; ++k) {
            put(sent, range.table);
            put(sent, k);
            if (range.table == Table::joints)
                put(sent, state.joints[k]);
            else
                put(sent, state.vehicles[k]);
        }
    TableRanges found;
    for (const Bytes& received : exchange_->all_gather(sent))
        for (Unpacker from(received); from.has_more();) {
            const auto table = from.take<Table>();
            const auto k = from.take<std::size_t>();
            if (table == Table::joints)
                from.take(state.joints[k]);
            else
                from.take(state.vehicles[k]);
            found.push_back({table, k, 1});
        }
    device_.store(found);
}

void DistributedRunner::sync_broken() {
    State& state = *state_;
    sync_ownerless(/* breaks */ true);
    Bytes sent;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        if (state.is_owned(row) && state.forces[row].kept < 1)
            put(sent, BrokenBody{row, state.poses[row], state.velocities[row]});
        if (!state.is_owned(row)) state.forces[row].kept = 1;
    }
    for (const Bytes& received : exchange_->all_gather(sent))
        for (Unpacker from(received); from.has_more();) {
            const auto body = from.take<BrokenBody>();
            state.poses[body.row] = body.pose;
            state.velocities[body.row] = body.velocity;
            state.forces[body.row].kept = 0;
            ownership_.inherit(state, body.row);
        }
}

}  // namespace scree
