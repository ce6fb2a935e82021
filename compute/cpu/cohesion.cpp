// Reference stages of cohesion: what contacts attract their bodies with.
#include "shaders/physics/contact/cohesion.h"

#include "compute/cpu/contact_runs.h"
#include "compute/cpu/stages.h"

namespace scree::reference {

namespace {

physics::uint attracting_points_of(const State& state, std::size_t contact, float range) {
    return physics::attracting_points(state.contacts[contact].count, state.impulses[contact].separation, range);
}

// Contacts of a pair of bodies that attract them.
std::size_t attracting_contacts(const State& state, const physics::Contact& contact, std::size_t body_with_slots, float range) {
    const std::uint32_t a = state.body_of(contact.a), b = state.body_of(contact.b);
    std::size_t found = 0;
    for (std::size_t k = state.first_slot_of(body_with_slots); k < state.slot_ends[body_with_slots]; ++k) {
        if ((state.slot_sides[k] & physics::OF_JOINT) != 0) continue;
        const std::size_t other = state.slot_sides[k] / 2;
        found += state.body_of(state.contacts[other].a) == a && state.body_of(state.contacts[other].b) == b &&
                 attracting_points_of(state, other, range) != 0;
    }
    return found;
}

physics::Attraction attraction_of(const State& state, std::size_t i) {
    const physics::Contact& contact = state.contacts[i];
    const physics::BodyProperties &ta = state.properties[contact.a], &tb = state.properties[contact.b];
    const physics::uint a = physics::surface_of(ta), b = physics::surface_of(tb);
    if (!is_solved(state, i) || a == 0 || b == 0) return physics::no_attraction();
    const physics::Cohesion cohesion =
        physics::cohesion_between(ta, state.surfaces[a - 1], tb, state.surfaces[b - 1], state.fixed());
    if (cohesion.force <= 0) return physics::no_attraction();
    const physics::uint points = attracting_points_of(state, i, cohesion.range);
    std::size_t contacts = 1;
    if (points != 0 && (physics::is_part(ta) || physics::is_part(tb))) {
        const bool moves_a = state.contact_slots[2 * i] != physics::NONE;
        contacts = attracting_contacts(state, contact, state.body_of(moves_a ? contact.a : contact.b), cohesion.range);
    }
    return physics::shared_force(cohesion, points, static_cast<float>(contacts));
}

void attract(State& state, std::size_t i) {
    const physics::Attraction attraction{state.attractions[2 * i], static_cast<physics::uint>(state.attractions[2 * i + 1])};
    if (attraction.force <= 0) return;
    const physics::Constraint& c = state.constraints[i];
    const physics::VelocityPair change =
        physics::changes_by_attraction(c, state.impulses[i].center_offset, attraction, physics::whole_mass(state.masses[c.a]),
                                       physics::whole_mass(state.masses[c.b]), state.fixed());
    const auto add = [&](std::uint32_t slot, const physics::Velocity& to) {
        if (slot != physics::NONE) state.slots[slot] = physics::with_change(state.slots[slot], to);
    };
    add(c.slot_a, change.a);
    add(c.slot_b, change.b);
}

}  // namespace

void prepare_cohesion(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        const physics::Attraction found = attraction_of(state, i);
        state.attractions[2 * i] = found.force;
        state.attractions[2 * i + 1] = static_cast<float>(found.points);
    });
}

void apply_cohesion(State& state, const Threads& threads, std::uint32_t) {
    const auto alone = [&](std::size_t i) { attract(state, i); };
    if (const WideStages* wide = wide_stages(threads.lanes()))
        for_each_group(state, threads, wide_tables(state, state.contacts_to_solve), *wide, wide->attract, alone);
    else
        threads.for_each(state.counted().solver_contacts, [&](std::size_t k) { alone(state.contacts_to_solve[k]); });
}

}  // namespace scree::reference
