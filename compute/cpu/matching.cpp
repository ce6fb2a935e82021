// Reference matching of pairs: their types, their contacts of the last step, and which of these persist.
#include <algorithm>
#include <vector>

#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/solve/motion.h"
#include "shaders/physics/solve/persistence.h"

namespace scree::reference {

namespace {

// Id of the partner in a contact of the last step.
std::uint32_t partner_before(const State& state, std::uint32_t owner, std::size_t contact) {
    const physics::Contact& before = state.contacts_before[contact];
    return state.id_of(before.a == owner ? before.b : before.a);
}

// The contact of the last step that `owner` owned with the body of that id, from the contact `from` on, which is moved up to
// that id: each body's contacts are in the order of their partners' ids.
std::uint32_t contact_before(const State& state, std::uint32_t owner, std::uint32_t id, std::uint32_t& from) {
    const std::uint32_t last = state.first_contacts[owner + 1];
    for (; from < last; ++from) {
        const std::uint32_t partner = partner_before(state, owner, from);
        if (partner >= id) return partner == id ? from : physics::NONE;
    }
    return physics::NONE;
}

constexpr std::uint8_t still_kind = 0x80;

// What matching asks of each row.
void list_rows(State& state, const Threads& threads) {
    state.least_partners.resize(state.fixed().bodies);
    state.row_kinds.resize(state.fixed().bodies);
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const bool is_still = (state.bounds[i].level & physics::INACTIVE) != 0;
        state.row_kinds[i] = static_cast<std::uint8_t>(state.properties[i].shape | (is_still ? still_kind : 0u));
        const std::uint32_t first = state.first_contacts[i];
        state.least_partners[i] =
            first == state.first_contacts[i + 1] ? physics::NONE : partner_before(state, static_cast<std::uint32_t>(i), first);
    });
}

// `from`: as for contact_before, of the owner's contacts.
physics::Pair matched(const State& state, const physics::Candidate& candidate, std::uint32_t& from) {
    const std::uint32_t id = state.id_of(candidate.owner), other_id = state.id_of(candidate.other);
    physics::Pair pair{candidate.owner, candidate.other, 0, physics::NONE};
    if (other_id < id) std::swap(pair.a, pair.b);
    if (!state.is_newborn(state.copy_of(pair.a))) {
        pair.previous = contact_before(state, candidate.owner, other_id, from);
        if (pair.previous == physics::NONE && state.least_partners[candidate.other] <= id) {
            std::uint32_t first = state.first_contacts[candidate.other];
            pair.previous = contact_before(state, candidate.other, id, first);
        }
    }
    const std::uint8_t kind_a = state.row_kinds[pair.a], kind_b = state.row_kinds[pair.b];
    const bool inactive = (kind_a & kind_b & still_kind) != 0;
    pair.pair_type = inactive ? physics::PAIR_INACTIVE : physics::pair_type_of(kind_a & ~still_kind, kind_b & ~still_kind);
    return pair;
}

// Whether the pair's contact of the last step may persist (persistence.h).
bool may_persist(const State& state, const physics::Pair& pair) {
    return pair.pair_type != physics::PAIR_INACTIVE && pair.previous != physics::NONE &&
           physics::has_weight(felt_by(state, state.body_of(pair.a))) &&
           physics::may_persist(state.impulses_before[pair.previous], state.properties[pair.a], state.properties[pair.b]);
}
bool persists(const State& state, const physics::Pair& pair) {
    const std::uint32_t a = state.body_of(pair.a), b = state.body_of(pair.b);
    return physics::is_persistent(state.contacts_before[pair.previous], state.properties[pair.a], state.poses[a],
                                  state.velocities[a], state.properties[pair.b], state.poses[b], state.velocities[b]);
}

// Makes those of the pairs [first, last) persistent whose contacts of the last step persist.
void find_persistent(State& state, const WideStages* wide, std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> found;
    found.reserve(last - first);
    for (std::size_t i = first; i < last; ++i)
        if (may_persist(state, state.pairs[i])) found.push_back(static_cast<std::uint32_t>(i));
    if (wide) return wide->keep(wide_tables(state, found), 0, found.size());
    for (const std::uint32_t i : found)
        if (persists(state, state.pairs[i])) state.pairs[i].pair_type = physics::PAIR_PERSISTENT;
}

}  // namespace

void match_pairs(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const WideStages* wide = wide_stages(threads.lanes());
    if (state.pair_manifolds.size() < state.counted().pairs) state.pair_manifolds.resize(state.fixed().pair_capacity);
    list_rows(state, threads);
    threads.for_ranges(state.fixed().bodies, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::uint32_t from = state.first_contacts[i];
            const auto first = state.candidates.begin() + state.pair_starts[i];
            const auto last = state.candidates.begin() + state.pair_starts[i + 1];
            std::sort(first, last, [&](const auto& x, const auto& y) { return state.id_of(x.other) < state.id_of(y.other); });
            std::transform(first, last, state.pairs.begin() + state.pair_starts[i],
                           [&](const physics::Candidate& candidate) { return matched(state, candidate, from); });
        }
        find_persistent(state, wide, state.pair_starts[begin], state.pair_starts[end]);
    });
}

}  // namespace scree::reference
