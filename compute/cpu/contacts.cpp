// Reference contact stages before the solver: contacts, and the warm start from the last step.
#include "compute/cpu/contact_runs.h"
#include "compute/cpu/images.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/contact/contact_preparation.h"

namespace scree::reference {

namespace {

physics::uint slot_of(const State& state, std::size_t contact, std::size_t side) {
    return state.contact_slots[2 * contact + side];
}

// Last step's impulses, and what else the contact takes from then.
physics::PreparedContact warm_started_contact(const State& state, std::size_t i) {
    const physics::Pair& pair = state.pairs[state.contact_pairs[i]];
    if (pair.previous == physics::NONE) return physics::without_impulses(state.contacts[i]);
    const physics::BodyProperties &ta = state.properties[pair.a], &tb = state.properties[pair.b];
    const physics::Contact& before = state.contacts_before[pair.previous];
    const physics::Impulse was = state.impulse_before(pair.previous);
    physics::PreparedContact prepared =
        physics::is_carried_forward(pair.pair_type)
            ? physics::carried_forward(before, was, state.scratch.pair_manifolds[state.contact_pairs[i]])
            : physics::warm_started(physics::without_impulses(state.contacts[i]), before, was, ta, tb);
    const physics::uint slot_a = slot_of(state, i, 0), slot_b = slot_of(state, i, 1);
    const bool idle = physics::is_idle(slot_a, slot_b);
    // Unchanged between two inactive bodies.
    if (!idle || pair.pair_type != physics::PAIR_INACTIVE)
        prepared.contact.load = physics::load_since(before, was, ta, slot_a, tb, slot_b);
    if (idle) return prepared;
    prepared.impulse.normal_sum = physics::normal_impulse(prepared.impulse);
    if (physics::rebounds_across(physics::contact_impact_of(prepared.impulse))) {
        const std::uint32_t a = state.body_of(pair.a);
        const physics::Parameters parameters = parameters_of(state, a);
        prepared.impulse = physics::settled_impact(prepared.impulse,
                                                   physics::constraint_of(prepared.contact, ta, tb, slot_a, slot_b, parameters),
                                                   was, physics::constraint_of(before, ta, tb, slot_a, slot_b, parameters),
                                                   {state.velocities[a], as_met(state, pair.a, pair.b).velocity});
    }
    return prepared;
}

}  // namespace

void make_contacts(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        if (!physics::has_points(state.point_counts[i])) return;
        const std::uint32_t contact = state.contact_starts[i];
        const physics::Pair& pair = state.pairs[i];
        state.contacts[contact] =
            physics::is_carried_forward(pair.pair_type)
                ? state.contacts_before[pair.previous]
                : physics::contact_of(pair, state.scratch.pair_manifolds[i], state.point_counts[i],
                                      state.poses[state.body_of(pair.a)], as_met(state, pair.a, pair.b).pose);
        state.contact_pairs[contact] = static_cast<std::uint32_t>(i);
        state.contact_slots[2 * contact] = state.contact_slots[2 * contact + 1] = physics::NONE;
        if (!state.reordered()) return;
        const bool is_a = state.pair_starts[pair.a] <= i && i < state.pair_starts[pair.a + 1];
        state.contact_owners[contact] = state.id_of(is_a ? pair.a : pair.b);
    });
}

void warm_start_contacts(State& state, const Threads& threads, std::uint32_t) {
    const bool in_lanes = wide_stages(threads.lanes()) && wide_tables(state, state.contacts_to_solve).warm_starts;
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        if (in_lanes && is_solved(state, i)) return;
        const physics::PreparedContact prepared = warm_started_contact(state, i);
        state.contacts[i].load = prepared.contact.load;
        state.keep_impulse(i, prepared.impulse);
    });
}

}  // namespace scree::reference
