// Reference stage of cohesion: what their contacts attract bodies with.
#include "shaders/physics/contact/cohesion.h"

#include "compute/cpu/stages.h"

namespace scree::reference {

namespace {

physics::Cohesion cohesion_of(const State& state, const physics::Contact& contact) {
    const physics::BodyProperties &ta = state.properties[contact.a], &tb = state.properties[contact.b];
    const physics::uint a = physics::surface_of(ta), b = physics::surface_of(tb);
    if (a == 0 || b == 0) return {0, 0};
    return physics::cohesion_between(ta, state.surfaces[a - 1], tb, state.surfaces[b - 1], state.fixed());
}

bool is_attracting(const State& state, std::size_t contact, float range) {
    return physics::attracting_points(state.contacts[contact].count, state.impulses[contact].separation, range) > 0;
}

// The part of a pair's force that each of its contacts has which attract the bodies. `body`: one whose slots have all of them.
float part_of_pair(const State& state, const physics::Constraint& c, float range, std::size_t body) {
    std::size_t contacts = 0;
    for (std::size_t k = state.first_slot_of(body); k < state.slot_ends[body]; ++k) {
        const std::size_t contact = state.slot_sides[k] / 2;
        if ((state.slot_sides[k] & physics::OF_JOINT) != 0) continue;
        const physics::Contact& other = state.contacts[contact];
        contacts += state.body_of(other.a) == c.a && state.body_of(other.b) == c.b && is_attracting(state, contact, range);
    }
    return physics::reciprocal(static_cast<float>(contacts));
}

physics::Wrench attraction_in(const State& state, std::size_t body, std::uint32_t side) {
    const std::size_t i = side / 2;
    const physics::Contact& contact = state.contacts[i];
    const physics::Cohesion cohesion = cohesion_of(state, contact);
    if (cohesion.force <= 0 || !is_attracting(state, i, cohesion.range)) return {};
    const physics::Constraint& c = state.constraints[i];
    const bool of_parts = physics::is_part(state.properties[contact.a]) || physics::is_part(state.properties[contact.b]);
    const float part = of_parts ? part_of_pair(state, c, cohesion.range, body) : 1;
    return physics::attraction(c, state.impulses[i], cohesion, part, side % 2, state.velocities[c.a], state.velocities[c.b],
                               state.fixed());
}

}  // namespace

void apply_cohesion(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    threads.for_each(state.fixed().first_part, [&](std::size_t i) {
        const std::size_t first = state.first_slot_of(i), last = state.slot_ends[i];
        if (first == last || !state.is_owned(i)) return;
        physics::Wrench sum{};
        for (std::size_t k = first; k < last; ++k)
            if ((state.slot_sides[k] & physics::OF_JOINT) == 0)
                sum = physics::plus(sum, attraction_in(state, i, state.slot_sides[k]));
        state.forces[i] = physics::with_attraction(state.forces[i], sum, physics::whole_mass(state.masses[i]));
    });
}

}  // namespace scree::reference
