// Reference matching of pairs: their types, their contacts of the last step, and which of these persist.
#include <algorithm>
#include <span>
#include <vector>

#include "compute/cpu/images.h"
#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/contact/persistence.h"

namespace scree::reference {

namespace {

constexpr std::uint8_t still_kind = 0x80;

// What matching asks of each row, and of each contact of the last step: the id of its owner's partner.
void list_rows(State& state, const Threads& threads) {
    state.scratch.partners_before.resize(state.contacts_before.size());
    state.scratch.row_kinds.resize(state.fixed().bodies);
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const bool is_still = (state.bounds[i].level & physics::INACTIVE) != 0;
        state.scratch.row_kinds[i] = static_cast<std::uint8_t>(state.properties[i].shape | (is_still ? still_kind : 0u));
        for (std::uint32_t k = state.first_contacts[i]; k < state.first_contacts[i + 1]; ++k) {
            const physics::Contact& before = state.contacts_before[k];
            state.scratch.partners_before[k] = state.id_of(before.a == i ? before.b : before.a);
        }
    });
}

// The contact of the last step that `owner` owned with the body of that id, from the contact `from` on, which is moved up to
// that id: each body's contacts are in the order of their partners' ids.
std::uint32_t contact_before(const State& state, std::uint32_t owner, std::uint32_t id, std::uint32_t& from) {
    const std::uint32_t last = state.first_contacts[owner + 1];
    while (from < last && state.scratch.partners_before[from] < id) ++from;
    return from < last && state.scratch.partners_before[from] == id ? from : physics::NONE;
}

// In the order of the partners' ids. Most bodies have few candidates, which are in this order already.
void sort_candidates(const State& state, std::span<physics::Candidate> candidates) {
    const auto before = [&](const auto& x, const auto& y) { return state.id_of(x.other) < state.id_of(y.other); };
    if (!std::is_sorted(candidates.begin(), candidates.end(), before)) std::sort(candidates.begin(), candidates.end(), before);
}

// `from`: as for contact_before, of the owner's contacts.
physics::Pair matched(const State& state, const physics::Candidate& candidate, std::uint32_t& from) {
    const std::uint32_t id = state.id_of(candidate.owner), other_id = state.id_of(candidate.other);
    physics::Pair pair{candidate.owner, candidate.other, 0, physics::NONE};
    if (other_id < id) std::swap(pair.a, pair.b);
    if (!state.is_newborn(state.copy_of(pair.a))) {
        pair.previous = contact_before(state, candidate.owner, other_id, from);
        std::uint32_t first = state.first_contacts[candidate.other];
        if (pair.previous == physics::NONE) pair.previous = contact_before(state, candidate.other, id, first);
    }
    const std::uint8_t kind_a = state.scratch.row_kinds[pair.a], kind_b = state.scratch.row_kinds[pair.b];
    const bool inactive = (kind_a & kind_b & still_kind) != 0;
    pair.pair_type = inactive ? physics::PAIR_INACTIVE : physics::pair_type_of(kind_a & ~still_kind, kind_b & ~still_kind);
    return pair;
}

// Whether the pair's contact of the last step may persist (persistence.h).
bool may_persist(const State& state, const physics::Pair& pair) {
    return pair.pair_type != physics::PAIR_INACTIVE && pair.previous != physics::NONE &&
           physics::may_persist(state.impulse_before(pair.previous), state.scratch.row_kinds[pair.a] & ~still_kind,
                                state.scratch.row_kinds[pair.b] & ~still_kind) &&
           physics::has_weight(parameters_of(state, state.body_of(pair.a)));
}
bool persists(const State& state, const physics::Pair& pair) {
    const std::uint32_t a = state.body_of(pair.a);
    const MetBody b = as_met(state, pair.a, pair.b);
    return physics::is_persistent(state.contacts_before[pair.previous], state.properties[pair.a], state.poses[a],
                                  state.velocities[a], state.properties[pair.b], b.pose, b.velocity);
}

}  // namespace

void match_pairs(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const WideStages* wide = wide_stages(threads.lanes());
    if (state.scratch.pair_manifolds.size() < state.counted().pairs)
        state.scratch.pair_manifolds.resize(state.fixed().pair_capacity);
    list_rows(state, threads);
    threads.for_ranges(state.fixed().bodies, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> asked;  // pairs that may persist
        asked.reserve(state.pair_starts[end] - state.pair_starts[begin]);
        for (std::size_t i = begin; i < end; ++i) {
            std::uint32_t from = state.first_contacts[i], index = state.pair_starts[i];
            const std::span candidates = std::span(state.candidates).subspan(index, state.pair_starts[i + 1] - index);
            sort_candidates(state, candidates);
            for (const physics::Candidate& candidate : candidates) {
                const physics::Pair pair = matched(state, candidate, from);
                if (may_persist(state, pair)) asked.push_back(index);
                state.pairs[index++] = pair;
            }
        }
        if (wide) return wide->keep(wide_tables(state, asked), 0, asked.size());
        for (const std::uint32_t index : asked)
            if (persists(state, state.pairs[index])) state.pairs[index].pair_type = physics::PAIR_PERSISTENT;
    });
}

}  // namespace scree::reference
