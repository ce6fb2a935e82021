// Finding ghosts, and keeping them up to date.
#include "compute/distributed/halo.h"

#include <algorithm>
#include <cmath>

#include "compute/distributed/cell_set.h"
#include "compute/distributed/packing.h"
#include "compute/tables/lasting.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/collide/grid.h"

namespace scree {

namespace {

// Width of a fine cell over that of a coarse one: a power of two, so that fine cells lie in coarse ones.
constexpr float coarse = 1.0f / 8;

struct GhostAtStart {
    std::uint32_t id = 0;
    physics::BodyForces forces;
    GhostRecords records;
};
struct FreshGhost {
    std::uint32_t id = 0;
    physics::BodyProperties properties;
};
struct GhostVelocity {
    physics::Velocity velocity;
    float shares = 0;
};
struct GhostMotion {
    physics::Velocity velocity;
    physics::vec4 orientation;
    float impact_weight = 0;
    float impact_debt = 0;
};
struct GhostEnd {
    physics::Pose pose;
    physics::Sweep sweep;
};
struct GhostStops {
    std::uint32_t stops[2] = {0, 0};
};

bool overlap(const physics::vec3& lower_a, const physics::vec3& upper_a, const physics::vec3& lower_b,
             const physics::vec3& upper_b) {
    return physics::boxes_overlap(lower_a, upper_a, lower_b, upper_b);
}

}  // namespace

// Anew in each step: a compound may come into spare rows.
void Halo::note_reach(const State& state) {
    reach_.clear();
    if (!state.features().moving_parts) return;
    reach_.assign(state.fixed().first_part, 0.0f);
    for (std::uint32_t row = state.fixed().first_part; row < state.fixed().bodies; ++row) {
        const physics::BodyProperties& part = state.properties[row];
        if (!physics::is_part(part) || physics::motion_of(part) == physics::MOTION_FIXED) continue;
        float& reach = reach_[part.owner];
        reach = std::max(reach, physics::length3(state.part_in(row).position) + physics::bounding_radius(part));
    }
}

// Not smaller than the bounds of the body and its parts in this step.
Halo::Box Halo::box_of(const State& state, std::uint32_t row) const {
    const physics::Parameters& p = state.fixed();
    const physics::BodyProperties& body = state.properties[row];
    const physics::Pose& pose = state.poses[row];
    const physics::Velocity& velocity = state.velocities[row];
    if (physics::is_apart(body)) return {};
    const float reach = reach_.empty() ? 0 : reach_[row];
    if (reach == 0) {
        if (body.shape == physics::SHAPE_NONE) return {};
        const physics::Bounds bounds = physics::bounds_of(body, 0, pose, velocity, state.forces[row], p);
        return {bounds.lower, bounds.upper};
    }
    const float spin = glm::length(velocity.angular) * p.dt;
    const float way = glm::length(velocity.linear) * p.dt + reach * spin * (1 + spin) +
                      glm::length(state.forces[row].acceleration) * p.dt * p.dt;
    const physics::vec3 half(1.01f * (reach + way + p.speculative));
    return {pose.position - half, pose.position + half};
}

void Halo::find_near(const State& state, Exchange& exchange) {
    std::vector<std::uint32_t> rows;
    std::vector<Box> boxes;
    Box all;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        if (!state.is_owned(row)) continue;
        const Box box = box_of(state, row);
        if (!(box.lower.x <= box.upper.x && box.lower.y <= box.upper.y && box.lower.z <= box.upper.z)) continue;  // nor NaN
        rows.push_back(row);
        boxes.push_back(box);
        all = {glm::min(all.lower, box.lower), glm::max(all.upper, box.upper)};
    }
    Bytes sent;
    put(sent, all);
    const auto ranks = static_cast<std::size_t>(exchange.ranks()), own = static_cast<std::size_t>(exchange.rank());
    std::vector<Box> theirs(ranks);
    const std::vector<Bytes> received = exchange.all_gather(sent);
    for (std::size_t r = 0; r < ranks; ++r) Unpacker(received[r]).take(theirs[r]);
    const auto may_touch = [&](std::size_t r) {
        return r != own && overlap(all.lower, all.upper, theirs[r].lower, theirs[r].upper);
    };
    // To each neighbour coarse cells of the bodies within its bounds; then of those in its coarse cells the fine ones.
    std::vector<Bytes> own_cells(ranks);
    std::vector<std::vector<std::size_t>> near(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        if (!may_touch(r)) continue;
        CellSet set(coarse * state.fixed().inverse_cell);
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            if (!overlap(boxes[k].lower, boxes[k].upper, theirs[r].lower, theirs[r].upper)) continue;
            near[r].push_back(k);
            set.add(boxes[k].lower, boxes[k].upper);
        }
        own_cells[r] = set.bytes();
    }
    const std::vector<Bytes> regions = exchange.all_to_all(own_cells);
    for (std::size_t r = 0; r < ranks; ++r) {
        own_cells[r].clear();
        if (!may_touch(r)) continue;
        const CellSet region(coarse * state.fixed().inverse_cell, regions[r]);
        std::erase_if(near[r], [&](std::size_t k) { return !region.meets(boxes[k].lower, boxes[k].upper); });
        CellSet set(state.fixed().inverse_cell);
        for (const std::size_t k : near[r]) set.add(boxes[k].lower, boxes[k].upper);
        own_cells[r] = set.bytes();
    }
    const std::vector<Bytes> sets = exchange.all_to_all(own_cells);
    for (std::size_t r = 0; r < ranks; ++r) {
        if (!may_touch(r)) continue;
        const CellSet set(state.fixed().inverse_cell, sets[r]);
        for (const std::size_t k : near[r])
            if (set.meets(boxes[k].lower, boxes[k].upper)) to_[r].push_back(rows[k]);
    }
}

// Two bodies asleep keep their contact, wherever their bounds are.
void Halo::find_touched(const State& state, const Ownership& ownership, const Exchange& exchange) {
    const std::uint32_t count = state.first_contacts[state.fixed().bodies];
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t a = state.body_of(state.contacts_before[k].a), b = state.body_of(state.contacts_before[k].b);
        const auto note = [&](std::uint32_t row, std::uint32_t other) {
            if (!state.is_owned(row) || state.properties[other].motion != physics::MOTION_DYNAMIC) return;
            const int owner = ownership.owner_of(state, other);
            if (owner != exchange.rank()) to_[static_cast<std::size_t>(owner)].push_back(row);
        };
        note(a, b);
        note(b, a);
    }
}

void Halo::find(State& state, const Ownership& ownership, Exchange& exchange, Share& share) {
    const auto ranks = static_cast<std::size_t>(exchange.ranks());
    for (const std::vector<std::uint32_t>& rows : from_)
        for (const std::uint32_t row : rows)
            if (row < state.presence.size() && state.presence[row] == Presence::ghost)  // less rows after a restore
                state.presence[row] = Presence::elsewhere;
    to_.assign(ranks, {});
    from_.assign(ranks, {});
    if (ranks == 1) return;
    note_reach(state);
    find_near(state, exchange);
    find_touched(state, ownership, exchange);
    std::vector<Bytes> ghosts(ranks);
    known_.resize(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        std::sort(to_[r].begin(), to_[r].end());
        to_[r].erase(std::unique(to_[r].begin(), to_[r].end()), to_[r].end());
        ghosts[r] = start_of(state, to_[r], known_[r]);
    }
    take_ghosts(state, share, exchange.all_to_all(ghosts));
    for (std::uint32_t row = state.fixed().first_part; row < state.fixed().bodies; ++row)
        state.presence[row] = state.presence[state.properties[row].owner];
}

// A share has no properties of bodies that were not here in the last step.
Bytes Halo::start_of(const State& state, const std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& known) const {
    Bytes ghosts, fresh;
    std::vector<std::uint32_t> ids;
    for (const std::uint32_t row : rows) {
        const std::uint32_t id = state.id_of(row);
        put(ghosts, GhostAtStart{id, state.forces[row], GhostRecords::of(state, row)});
        if (!state.is_share()) continue;
        ids.push_back(id);
        if (!std::binary_search(known.begin(), known.end(), id)) put(fresh, FreshGhost{id, state.properties[row]});
    }
    std::sort(ids.begin(), ids.end());
    known.swap(ids);
    if (ghosts.empty()) return {};
    Bytes all;
    put(all, static_cast<std::uint64_t>(rows.size()));
    all.insert(all.end(), ghosts.begin(), ghosts.end());
    all.insert(all.end(), fresh.begin(), fresh.end());
    return all;
}

void Halo::take_ghosts(State& state, Share& share, const std::vector<Bytes>& sent) {
    std::vector<std::vector<GhostAtStart>> ghosts(sent.size());
    std::vector<FreshGhost> fresh;
    std::vector<std::uint32_t> ids;
    for (std::size_t r = 0; r < sent.size(); ++r) {
        if (sent[r].empty()) continue;
        Unpacker from(sent[r]);
        for (auto left = from.take<std::uint64_t>(); left > 0; --left) ids.push_back(from.take(ghosts[r].emplace_back()).id);
        while (from.has_more()) from.take(fresh.emplace_back());
    }
    const auto note = [&](std::uint32_t id) {
        if (const std::uint32_t row = state.row_of(id); row != physics::NONE) state.presence[row] = Presence::ghost;
    };
    std::for_each(ids.begin(), ids.end(), note);  // before rows are taken from others
    share.take_in(state, ids);
    std::for_each(ids.begin(), ids.end(), note);
    for (const FreshGhost& one : fresh) {
        const std::uint32_t row = state.row_of(one.id);
        state.properties[row] = owned_by(row, one.properties);
    }
    for (std::size_t r = 0; r < ghosts.size(); ++r)
        for (const GhostAtStart& ghost : ghosts[r]) {
            const std::uint32_t row = state.row_of(ghost.id);
            from_[r].push_back(row);
            state.forces[row] = ghost.forces;
            ghost.records.put(state, row);
        }
}

void Halo::forget() {
    to_.clear();
    from_.clear();
    known_.clear();
}

static std::vector<std::uint32_t> united(const std::vector<std::vector<std::uint32_t>>& of_ranks) {
    std::vector<std::uint32_t> rows;
    for (const std::vector<std::uint32_t>& some : of_ranks) rows.insert(rows.end(), some.begin(), some.end());
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
}
std::vector<std::uint32_t> Halo::sent_rows() const {
    return united(to_);
}
std::vector<std::uint32_t> Halo::ghost_rows() const {
    return united(from_);
}

std::size_t Halo::ghosts() const {
    std::size_t count = 0;
    for (const std::vector<std::uint32_t>& rows : from_) count += rows.size();
    return count;
}

template <class Record, class Of, class Take>
void Halo::start(const State& state, Exchange& exchange, const Of& of, const Take& take) {
    const std::size_t ranks = to_.size();
    outgoing_.resize(ranks);
    incoming_.resize(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        outgoing_[r].resize(to_[r].size() * sizeof(Record));
        incoming_[r].resize(from_[r].size() * sizeof(Record));
        for (std::size_t k = 0; k < to_[r].size(); ++k) {
            const Record record = of(state, to_[r][k]);
            std::memcpy(&outgoing_[r][k * sizeof(Record)], &record, sizeof(Record));
        }
    }
    taking_ = [this, take](State& here) {
        for (std::size_t r = 0; r < from_.size(); ++r)
            for (std::size_t k = 0; k < from_[r].size(); ++k) {
                Record record;
                std::memcpy(&record, &incoming_[r][k * sizeof(Record)], sizeof(Record));
                take(here, from_[r][k], record);
            }
    };
    exchange.start(outgoing_, incoming_);
}

void Halo::finish(State& state, Exchange& exchange) {
    exchange.finish();
    taking_(state);
}

void Halo::send_sleep_states(State& state, Exchange& exchange) {
    send<std::uint32_t>(
        state, exchange, [](const State& s, std::uint32_t row) { return s.sleep_states[row]; },
        [](State& s, std::uint32_t row, const std::uint32_t& rest) { s.sleep_states[row] = rest; });
}

void Halo::send_struck(State& state, Exchange& exchange) {
    send<std::uint32_t>(
        state, exchange, [](const State& s, std::uint32_t row) { return s.bounds[row].sweep.marks; },
        [](State& s, std::uint32_t row, const std::uint32_t& marks) { s.bounds[row].sweep.marks = marks; });
    Bytes sent;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        if (state.presence[row] != Presence::everywhere || state.bounds[row].sweep.marks == 0) continue;
        put(sent, state.id_of(row));
        put(sent, state.bounds[row].sweep.marks);
    }
    for (const Bytes& received : exchange.all_gather(sent))
        for (Unpacker from(received); from.has_more();) {
            const std::uint32_t row = state.row_of(from.take<std::uint32_t>());
            state.bounds[row].sweep.marks |= from.take<std::uint32_t>();
        }
}

void Halo::start_velocities(State& state, Exchange& exchange) {
    start<GhostVelocity>(
        state, exchange,
        [](const State& s, std::uint32_t row) {
            return GhostVelocity{s.velocities[row], s.masses[row].shares};
        },
        [](State& s, std::uint32_t row, const GhostVelocity& ghost) {
            s.velocities[row] = ghost.velocity;
            s.masses[row].shares = ghost.shares;
        });
}

void Halo::start_motion(State& state, Exchange& exchange) {
    start<GhostMotion>(
        state, exchange,
        [](const State& s, std::uint32_t row) {
            return GhostMotion{s.velocities[row], s.poses[row].orientation, s.forces[row].impact_weight, s.impact_debts[row]};
        },
        [](State& s, std::uint32_t row, const GhostMotion& ghost) {
            s.velocities[row] = ghost.velocity;
            s.poses[row].orientation = ghost.orientation;
            s.forces[row].impact_weight = ghost.impact_weight;
            s.impact_debts[row] = ghost.impact_debt;
            if (!physics::has_isotropic_inertia(s.properties[row]))
                s.masses[row] = physics::turned_mass(s.masses[row], s.properties[row], ghost.orientation);
        });
}

void Halo::send_ends(State& state, Exchange& exchange) {
    send<GhostEnd>(
        state, exchange,
        [](const State& s, std::uint32_t row) {
            return GhostEnd{s.poses[row], s.bounds[row].sweep};
        },
        [](State& s, std::uint32_t row, const GhostEnd& ghost) {
            s.poses[row] = ghost.pose;
            s.bounds[row].sweep = ghost.sweep;
        });
}

void Halo::send_stops(State& state, Exchange& exchange) {
    send<GhostStops>(
        state, exchange,
        [](const State& s, std::uint32_t row) {
            return GhostStops{{s.bounds[row].sweep.stops[0], s.bounds[row].sweep.stops[1]}};
        },
        [](State& s, std::uint32_t row, const GhostStops& ghost) {
            s.bounds[row].sweep.stops[0] = ghost.stops[0];
            s.bounds[row].sweep.stops[1] = ghost.stops[1];
        });
}

void Halo::send_kept(State& state, Exchange& exchange) {
    send<float>(
        state, exchange, [](const State& s, std::uint32_t row) { return s.forces[row].kept; },
        [](State& s, std::uint32_t row, const float& kept) { s.forces[row].kept = kept; });
}

}  // namespace scree
