// Making, keeping and ending a share of the tables.
#include "compute/distributed/share.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "compute/distributed/packing.h"
#include "compute/tables/lasting.h"

namespace scree {

namespace {

constexpr std::uint32_t least_room = 64;

std::uint32_t with_room(std::size_t rows) {
    return static_cast<std::uint32_t>(rows + rows / 8 + least_room);
}

// Its memory, too.
template <class Record>
void release(std::vector<Record>& table) {
    std::vector<Record>().swap(table);
}

physics::BodyProperties empty_row(std::uint32_t row) {
    physics::BodyProperties none{};
    none.motion = physics::MOTION_PENDING;
    none.owner = row;
    none.fracture = none.joints = physics::NONE;
    return none;
}

// Moves records to new rows: `from` has the old one of each (NONE: an empty row), those of parts last.
class Rearrangement {
public:
    Rearrangement(State& state, std::vector<std::uint32_t> from, std::uint32_t first_part)
        : state_(state), from_(std::move(from)), to_(state.fixed().bodies, physics::NONE), first_part_(first_part) {
        for (std::uint32_t row = 0; row < from_.size(); ++row)
            if (from_[row] != physics::NONE) to_[from_[row]] = row;
    }
    // Contacts are those of the last step, before the tables are turned over.
    void move() {
        move_contacts();
        state_.slot_ends = counted_anew(state_.slot_ends, [](const auto& ends, std::uint32_t row) {
            return std::pair(row == 0 ? 0u : ends[row - 1], ends[row]);
        });
        std::rotate(state_.slot_ends.begin(), state_.slot_ends.begin() + 1, state_.slot_ends.end());  // ends, not starts
        state_.slot_ends.back() = 0;
#define SCREE_MOVE(buffer, name, block, record, length) \
    if constexpr (BufferLength::length == BufferLength::bodies) move_table(state_.name);
        SCREE_TABLES(SCREE_MOVE)
#undef SCREE_MOVE
        if (!state_.presence.empty()) move_table(state_.presence);
        for (std::uint32_t row = 0; row < from_.size(); ++row) {
            if (from_[row] == physics::NONE) {
                state_.properties[row] = empty_row(row);
                state_.ids[row] = physics::NONE;
            } else {
                follow(state_.properties[row].owner);
            }
        }
        physics::Parameters& p = state_.fixed();
        p.bodies = static_cast<std::uint32_t>(from_.size());
        p.first_part = first_part_;
        p.buckets = State::buckets_for(p.bodies);
        release(state_.cell_ends);
        release(state_.pair_starts);
        state_.allocate();
        state_.allocate_all();  // a world that was never whole here
    }

private:
    void follow(physics::uint& row) const {
        row = row < to_.size() ? to_[row] : physics::NONE;
    }
    template <class Record>
    void move_table(std::vector<Record>& table) {
        if (table.size() < to_.size()) return;
        std::vector<Record> moved(from_.size());
        for (std::size_t row = 0; row < from_.size(); ++row)
            if (from_[row] != physics::NONE) moved[row] = table[from_[row]];
        table.swap(moved);
    }
    // A table of first records by row, which has the end of all behind it.
    template <class RangeOf>
    std::vector<physics::uint> counted_anew(const std::vector<physics::uint>& table, const RangeOf& range_of) const {
        std::vector<physics::uint> starts(from_.size() + 1);
        for (std::size_t row = 0; row < from_.size(); ++row) {
            const bool is_empty = from_[row] == physics::NONE || table.empty();
            const auto [first, last] = is_empty ? std::pair(0u, 0u) : range_of(table, from_[row]);
            starts[row + 1] = starts[row] + last - first;
        }
        return starts;
    }
    void move_contacts() {
        std::vector<physics::uint> starts = counted_anew(
            state_.first_contacts, [](const auto& first, std::uint32_t row) { return std::pair(first[row], first[row + 1]); });
        for (std::size_t row = 0; row < from_.size(); ++row) {
            if (starts[row] == starts[row + 1]) continue;
            std::uint32_t old = state_.first_contacts[from_[row]];
            for (std::uint32_t k = starts[row]; k < starts[row + 1]; ++k, ++old) {
                ContactRecords::of(state_, old).put_before(state_, k);
                follow(state_.contacts_before[k].a);
                follow(state_.contacts_before[k].b);
            }
        }
        state_.turn_over();
        state_.counted().contacts = starts.back();
        state_.first_contacts.swap(starts);
    }

    State& state_;
    std::vector<std::uint32_t> from_, to_;
    std::uint32_t first_part_;
};

void drop_caches(State& state) {
    release(state.scratch.partners);
    release(state.scratch.partners_before);
    release(state.scratch.row_kinds);
    state.scratch.near_rows = {};
    release(state.scratch.movable_bodies);
    release(state.scratch.driven_bodies);
    release(state.scratch.paces);
    release(state.scratch.lane_bodies);
}

// The rows of parts follow those of bodies.
void append_parts(const State& state, std::vector<std::uint32_t>& from) {
    for (std::uint32_t row = state.fixed().first_part; row < state.fixed().bodies; ++row) from.push_back(row);
}

}  // namespace

bool Share::can_be_made(const State& state) {
    const SceneFeatures has = state.features();
    return !has.moving_parts && !has.joints && !has.breaking && !has.vehicles && !has.fields && !has.filters && !has.sums &&
           !has.copies && state.counted().quarantined == 0 && state.fixed().held == 0;
}

void Share::make(State& state) {
    const std::uint32_t first_part_id = state.fixed().first_part;
    std::vector<std::uint32_t> from;
    for (const Presence wanted : {Presence::everywhere, Presence::owned, Presence::ghost})
        for (std::uint32_t row = 0; row < first_part_id; ++row)
            if (state.presence[row] == wanted) from.push_back(row);
    const auto first_free = static_cast<std::uint32_t>(from.size()), first_part = with_room(from.size());
    from.resize(first_part, physics::NONE);
    append_parts(state, from);
    std::vector<std::uint32_t> rows(state.body_count, physics::NONE);
    for (std::uint32_t row = 0; row < first_free; ++row) rows[state.id_of(from[row])] = row;
    if (!state.reordered()) std::iota(state.ids.begin(), state.ids.end(), 0u);
    Rearrangement(state, std::move(from), first_part).move();
    state.first_part_id = first_part_id;
    state.assign_rows(std::move(rows));
    free_.resize(first_part - first_free);
    std::iota(free_.rbegin(), free_.rend(), first_free);
    drop_caches(state);
}

// Free rows even where there are no bodies: an empty table of presence says that all is here.
void Share::begin(State& state, std::span<const std::uint32_t> ids) {
    grow(state, static_cast<std::uint32_t>(ids.size()));
    take_in(state, ids);
    changes_ = {};
}

void Share::end(State& state, Exchange& exchange) {
    Bytes sent;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row)
        if (state.is_owned(row)) {
            put(sent, state.id_of(row));
            put(sent, RowRecords::of(state, row));
        }
    const std::uint32_t first_part = *state.first_part_id;
    std::vector<std::uint32_t> from(first_part, physics::NONE);
    for (std::uint32_t id = 0; id < state.body_count; ++id) from[id] = state.row_of(id);
    append_parts(state, from);
    Rearrangement(state, std::move(from), first_part).move();
    state.first_part_id.reset();
    free_.clear();
    changes_ = {};
    drop_caches(state);
    const std::vector<Bytes> received = exchange.all_gather(sent);
    for (std::size_t r = 0; r < received.size(); ++r) {
        if (r == static_cast<std::size_t>(exchange.rank())) continue;
        for (Unpacker bodies(received[r]); bodies.has_more();) {
            const auto id = bodies.take<std::uint32_t>();
            bodies.take<RowRecords>().put(state, id);
            state.properties[id].owner = id;
        }
    }
    state.take_rows({}, state.rows_bounce());
}

void Share::take_in(State& state, std::span<const std::uint32_t> ids) {
    if (!state.is_share()) return;
    const auto is_missing = [&](std::uint32_t id) { return state.row_of(id) == physics::NONE; };
    const auto missing = [&] { return static_cast<std::uint32_t>(std::count_if(ids.begin(), ids.end(), is_missing)); };
    if (missing() > free_.size()) {
        if (before_change) before_change();
        reclaim(state);
    }
    // Counted again: rows of these ids may have been among those.
    if (const std::uint32_t needed = missing(); needed > free_.size())
        grow(state, needed - static_cast<std::uint32_t>(free_.size()));
    for (const std::uint32_t id : ids) {
        if (!is_missing(id)) continue;
        const std::uint32_t row = free_.back();
        free_.pop_back();
        state.ids[row] = id;
        state.assign_row(id, row);
        changes_.rows.push_back(row);
    }
}

// The rows of bodies elsewhere, but for those in contacts.
void Share::reclaim(State& state) {
    std::vector<bool> in_contact(state.fixed().bodies);
    for (std::uint32_t k = 0; k < state.first_contacts[state.fixed().bodies]; ++k)
        in_contact[state.contacts_before[k].a] = in_contact[state.contacts_before[k].b] = true;
    for (std::uint32_t row = 0; row < state.fixed().first_part; ++row) {
        if (state.presence[row] != Presence::elsewhere || in_contact[row] || state.ids[row] == physics::NONE) continue;
        state.assign_row(state.ids[row], physics::NONE);
        state.ids[row] = physics::NONE;
        state.properties[row] = empty_row(row);
        free_.push_back(row);
        changes_.rows.push_back(row);
    }
}

void Share::grow(State& state, std::uint32_t rows) {
    changes_.moved = true;
    const std::uint32_t before = state.fixed().first_part, first_part = with_room(before + rows);
    std::vector<std::uint32_t> from(before);
    std::iota(from.begin(), from.end(), 0u);
    from.resize(first_part, physics::NONE);
    append_parts(state, from);
    state.turn_over();
    const std::uint32_t contacts = state.counted().contacts;
    Rearrangement(state, std::move(from), first_part).move();
    state.counted().contacts = contacts;
    state.turn_over();
    for (std::uint32_t row = first_part; row-- > before;) free_.push_back(row);
}

}  // namespace scree
