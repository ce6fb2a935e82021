// Reference broadphase: bodies sorted by bucket, pairs by owner and partner.
#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>

#include "compute/reference/stages.h"
#include "shaders/physics/grid.h"
#include "shaders/physics/persistence.h"

namespace scree::reference {

namespace {

std::span<const physics::CellEntry> entries(const State& state, std::size_t first, std::size_t last) {
    return std::span(state.cell_entries).subspan(first, last - first);
}

std::span<const physics::CellEntry> bucket(const State& state, std::size_t b) {
    return entries(state, b == 0 ? 0 : state.cells[b - 1], state.cells[b]);
}

bool near_large(const State& state, std::size_t body, const physics::CellEntry& other) {
    const physics::Bounds& own = state.bounds[body];
    const auto plane_reached = [&](std::size_t plane, physics::vec3 lower, physics::vec3 upper) {
        return physics::reaches_plane(lower, upper, state.traits[plane].size, state.poses[plane].position);
    };
    if (state.traits[other.body].shape == physics::SHAPE_PLANE) return plane_reached(other.body, own.lower, own.upper);
    if (state.traits[body].shape == physics::SHAPE_PLANE) return plane_reached(body, other.lower, other.upper);
    return physics::boxes_overlap(own.lower, own.upper, other.lower, other.upper);
}

// Calls found(other) for each body whose pair with `body` the latter owns.
template <typename Found>
void for_each_partner(const State& state, std::uint32_t body, const Found& found) {
    const physics::Parameters& p = state.fixed();
    const physics::Traits& own = state.traits[body];
    const physics::Bounds& around = state.bounds[body];
    for (const physics::CellEntry& other : bucket(state, p.buckets)) {
        if (own.large && other.body <= body) continue;
        if (physics::can_touch(own, state.traits[other.body]) && near_large(state, body, other)) found(other.body);
    }
    if (own.large) return;
    for (std::uint32_t levels = state.counted().levels & ~((1u << around.level) - 1); levels != 0; levels &= levels - 1) {
        const auto level = static_cast<std::uint32_t>(std::countr_zero(levels));
        const physics::ivec3 middle = physics::cell_of(around.lower, around.upper, level, p.inverse_cell);
        for (int neighbour = 0; neighbour < 27; ++neighbour) {
            const physics::ivec3 cell = middle + physics::ivec3(neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1);
            for (const physics::CellEntry& other : bucket(state, physics::bucket_of(cell, level, p.buckets))) {
                if (other.level != level || !physics::owns_pair(body, around.level, other.body, level)) continue;
                if (!physics::boxes_overlap(around.lower, around.upper, other.lower, other.upper)) continue;
                if (physics::cell_of(other.lower, other.upper, level, p.inverse_cell) != cell) continue;
                if (physics::can_touch(own, state.traits[other.body])) found(other.body);
            }
        }
    }
}

std::uint32_t contact_before(const State& state, std::uint32_t owner, std::uint32_t other) {
    const auto first = state.contacts_before.begin() + state.first_contacts_before[owner];
    const auto last = state.contacts_before.begin() + state.first_contacts_before[owner + 1];
    const auto partner = [owner](const physics::Contact& contact) { return contact.a == owner ? contact.b : contact.a; };
    const auto found = std::lower_bound(
        first, last, other, [&](const physics::Contact& contact, std::uint32_t body) { return partner(contact) < body; });
    return found != last && partner(*found) == other ? static_cast<std::uint32_t>(found - state.contacts_before.begin())
                                                     : physics::NONE;
}

}  // namespace

void fill_cells(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const std::uint32_t entry = std::atomic_ref(state.cells[state.bounds[i].bucket]).fetch_add(1, std::memory_order_relaxed);
        state.cell_entries[entry].body = static_cast<std::uint32_t>(i);
    });
}

void order_cells(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.fixed().buckets + 1, [&](std::size_t b) {
        const auto first = state.cell_entries.begin() + (b == 0 ? 0 : state.cells[b - 1]);
        const auto last = state.cell_entries.begin() + state.cells[b];
        std::sort(first, last, [](const auto& x, const auto& y) { return x.body < y.body; });
        std::for_each(first, last, [&](physics::CellEntry& entry) {
            const physics::Bounds& around = state.bounds[entry.body];
            entry = {around.lower, entry.body, around.upper, around.level};
        });
    });
}

void count_pairs(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        std::uint32_t count = 0;
        for_each_partner(state, static_cast<std::uint32_t>(i), [&](std::uint32_t) { ++count; });
        state.pair_starts[i] = count;
    });
}

void fill_pairs(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const auto owner = static_cast<std::uint32_t>(i);
        const auto first = state.pairs.begin() + state.pair_starts[i];
        auto next = first;
        for_each_partner(state, owner, [&](std::uint32_t other) {
            *next++ = {std::min(owner, other), std::max(owner, other), 0, physics::NONE};
        });
        // The pairs of one owner differ in their other body alone, so the sum orders them by it.
        std::sort(first, next, [](const physics::Pair& x, const physics::Pair& y) {
            return std::uint64_t{x.a} + x.b < std::uint64_t{y.a} + y.b;
        });
    });
}

void match_pairs(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        physics::Pair& pair = state.pairs[i];
        pair.previous = contact_before(state, pair.a, pair.b);
        if (pair.previous == physics::NONE) pair.previous = contact_before(state, pair.b, pair.a);
        const physics::Traits &ta = state.traits[pair.a], &tb = state.traits[pair.b];
        const bool kept =
            pair.previous != physics::NONE &&
            physics::is_kept(state.contacts_before[pair.previous], state.impulses_before[pair.previous], ta, state.poses[pair.a],
                             state.velocities[pair.a], tb, state.poses[pair.b], state.velocities[pair.b]);
        pair.kind = kept ? physics::KIND_KEPT : physics::kind_of(ta.shape, tb.shape);
    });
}

}  // namespace scree::reference
