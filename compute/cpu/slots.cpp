// Reference slots: the places of each body's contacts and joints in the table of velocity deltas.
#include <algorithm>
#include <utility>
#include <vector>

#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

void list_movable(State& state, const Threads& threads) {
    state.scratch.movable.resize(state.fixed().first_part);
    threads.for_each(state.scratch.movable.size(), [&](std::size_t i) {
        state.scratch.movable[i] =
            physics::is_movable(state.properties[i].motion, state.sleep_states[i], state.fixed().sleep_steps);
    });
}

// The bodies in contact. Pairs are read in place of the contacts, which are nine times as long.
std::pair<std::uint32_t, std::uint32_t> bodies_of(const State& state, std::size_t contact) {
    const physics::Pair& pair = state.pairs[state.contact_pairs[contact]];
    return {state.body_of(pair.a), state.body_of(pair.b)};
}

}  // namespace

void count_slots(State& state, const Threads& threads, std::uint32_t) {
    if (!physics::any_stirs(state.counted())) return;
    list_movable(state, threads);
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        const auto [a, b] = bodies_of(state, i);
        for (const std::uint32_t body : {a, b})
            if (state.scratch.movable[body]) taken(threads, state.slot_counts()[body]);
    });
}

void fill_slots(State& state, const Threads& threads, std::uint32_t) {
    if (!physics::any_stirs(state.counted())) return;
    physics::Counts& counts = state.counted();
    threads.for_ranges(counts.contacts, [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> solved;  // one atomic add per thread: one per contact took longer than the rest
        solved.reserve(last - first);
        for (auto contact = static_cast<std::uint32_t>(first); contact < last; ++contact) {
            const auto [a, b] = bodies_of(state, contact);
            const bool moves_a = state.scratch.movable[a], moves_b = state.scratch.movable[b];
            if (moves_a) state.slot_sides[taken(threads, state.slot_starts()[a])] = 2 * contact;
            if (moves_b) state.slot_sides[taken(threads, state.slot_starts()[b])] = 2 * contact + 1;
            if (moves_a || moves_b) solved.push_back(contact);
        }
        std::copy(
            solved.begin(), solved.end(),
            state.contacts_to_solve.begin() + taken(threads, counts.solver_contacts, static_cast<std::uint32_t>(solved.size())));
    });
}

void sort_slots(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const std::size_t n = state.fixed().bodies;
    threads.for_each(n, [&](std::size_t i) {
        state.first_contacts[i] = state.contact_starts[state.pair_starts[i]];
        const std::uint32_t first = state.first_slot_of(i);
        const std::uint32_t last = state.slot_ends[i];
        // Order of a body's slots, which fixes the order of its sum: by the id of the contact's owner, then by contact;
        // joints last.
        const auto key = [&](std::uint32_t side) {
            const bool of_joint = (side & physics::OF_JOINT) != 0;
            return std::pair(of_joint ? physics::NONE : state.contact_owners[side / 2], side);
        };
        const auto sides = state.slot_sides.begin();
        if (state.reordered())
            std::sort(sides + first, sides + last, [&](std::uint32_t x, std::uint32_t y) { return key(x) < key(y); });
        else
            std::sort(sides + first, sides + last);
        for (std::uint32_t slot = first; slot < last; ++slot) {
            const std::uint32_t side = state.slot_sides[slot];
            if (side & physics::OF_JOINT) {
                state.block_bodies[side & ~physics::OF_JOINT].slot = slot;
                continue;
            }
            state.contact_slots[side] = slot;
        }
    });
    state.first_contacts[n] = state.counted().contacts;
    state.counted().arguments[physics::WORK_SOLVER_CONTACTS] = physics::work_for(state.counted().solver_contacts, state.fixed());
}

}  // namespace scree::reference
