// Reference contact stages before the solver: contacts, their slots, and the warm start from the last step.
#include <algorithm>
#include <atomic>

#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/solve/contact_preparation.h"

namespace scree::reference {

namespace {

bool movable(const State& state, std::uint32_t body) {
    return physics::is_movable(state.properties[body].motion, state.sleep_states[body], state.fixed().sleep_steps);
}

std::uint32_t taken(std::uint32_t& end, std::uint32_t places = 1) {
    return std::atomic_ref(end).fetch_add(places, std::memory_order_relaxed);
}

physics::uint slot_of(const State& state, std::size_t contact, std::size_t side) {
    return state.contact_slots[2 * contact + side];
}

// Last step's impulses, and what else the contact takes from then.
physics::PreparedContact warm_started_contact(const State& state, std::size_t i) {
    const physics::Pair& pair = state.pairs[state.contact_pairs[i]];
    if (pair.previous == physics::NONE) return physics::without_impulses(state.contacts[i]);
    const physics::BodyProperties &ta = state.properties[pair.a], &tb = state.properties[pair.b];
    const physics::Contact& before = state.contacts_before[pair.previous];
    const physics::Impulse& was = state.impulses_before[pair.previous];
    physics::PreparedContact prepared =
        physics::is_carried_forward(pair.pair_type)
            ? physics::carried_forward(before, was, state.pair_manifolds[state.contact_pairs[i]])
            : physics::warm_started(physics::without_impulses(state.contacts[i]), before, was, ta, tb);
    const physics::uint slot_a = slot_of(state, i, 0), slot_b = slot_of(state, i, 1);
    const bool idle = physics::is_idle(slot_a, slot_b);
    // Unchanged between two inactive bodies.
    if (!idle || pair.pair_type != physics::PAIR_INACTIVE)
        prepared.contact.load = physics::load_since(before, was, ta, slot_a, tb, slot_b);
    if (idle) return prepared;
    prepared.impulse.normal_sum = physics::normal_impulse(prepared.impulse);
    if (physics::rebounds_across(prepared.impulse)) {
        const std::uint32_t a = state.body_of(pair.a), b = state.body_of(pair.b);
        const physics::Parameters felt = felt_by(state, a);
        prepared.impulse = physics::settled_impact(
            prepared.impulse, physics::constraint_of(prepared.contact, ta, tb, slot_a, slot_b, felt), was,
            physics::constraint_of(before, ta, tb, slot_a, slot_b, felt), {state.velocities[a], state.velocities[b]});
    }
    return prepared;
}

}  // namespace

void make_contacts(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        if (state.point_counts[i] == 0) return;
        const std::uint32_t contact = state.contact_starts[i];
        const physics::Pair& pair = state.pairs[i];
        state.contacts[contact] =
            physics::is_carried_forward(pair.pair_type)
                ? state.contacts_before[pair.previous]
                : physics::contact_of(pair, state.pair_manifolds[i], state.point_counts[i], state.poses[state.body_of(pair.a)],
                                      state.poses[state.body_of(pair.b)]);
        state.contact_pairs[contact] = static_cast<std::uint32_t>(i);
        state.contact_slots[2 * contact] = state.contact_slots[2 * contact + 1] = physics::NONE;
        if (!state.reordered()) return;
        const bool is_a = state.pair_starts[pair.a] <= i && i < state.pair_starts[pair.a + 1];
        state.contact_owners[contact] = state.id_of(is_a ? pair.a : pair.b);
    });
}

void count_slots(State& state, const Threads& threads, std::uint32_t) {
    if (!physics::any_stirs(state.counted())) return;
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        for (const std::uint32_t body : {state.body_of(state.contacts[i].a), state.body_of(state.contacts[i].b)})
            if (movable(state, body)) taken(state.slot_counts()[body]);
    });
}

void fill_slots(State& state, const Threads& threads, std::uint32_t) {
    if (!physics::any_stirs(state.counted())) return;
    physics::Counts& counts = state.counted();
    threads.for_ranges(counts.contacts, [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> solved;  // one atomic add per thread: one per contact took longer than the rest
        solved.reserve(last - first);
        for (auto contact = static_cast<std::uint32_t>(first); contact < last; ++contact) {
            const std::uint32_t a = state.body_of(state.contacts[contact].a), b = state.body_of(state.contacts[contact].b);
            const bool moves_a = movable(state, a), moves_b = movable(state, b);
            if (moves_a) state.slot_sides[taken(state.slot_starts()[a])] = 2 * contact;
            if (moves_b) state.slot_sides[taken(state.slot_starts()[b])] = 2 * contact + 1;
            if (moves_a || moves_b) solved.push_back(contact);
        }
        std::copy(solved.begin(), solved.end(),
                  state.contacts_to_solve.begin() + taken(counts.solver_contacts, static_cast<std::uint32_t>(solved.size())));
    });
    counts.arguments[physics::WORK_SOLVER_CONTACTS].x = physics::work_for(counts.solver_contacts, state.fixed()).x;
}

void sort_slots(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const std::size_t n = state.fixed().bodies;
    threads.for_each(n, [&](std::size_t i) {
        state.first_contacts[i] = state.contact_starts[state.pair_starts[i]];
        const std::uint32_t first = i == 0 ? 0 : state.slot_ends[i - 1];
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
}

void warm_start_contacts(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        const physics::PreparedContact prepared = warm_started_contact(state, i);
        state.contacts[i].load = prepared.contact.load;
        state.contacts[i].unrest = prepared.contact.unrest;
        state.impulses[i] = prepared.impulse;
    });
}

}  // namespace scree::reference
