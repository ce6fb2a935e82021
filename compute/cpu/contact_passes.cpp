// Reference contact stages of the solver: preparation, and the two passes of a substep.
#include <bit>

#include "compute/cpu/contact_runs.h"
#include "compute/cpu/images.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/passes.h"
#include "shaders/physics/contact/contact_pass.h"
#include "shaders/physics/contact/contact_preparation.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

physics::VelocityPair velocities_of(const State& state, const physics::Constraint& c) {
    const physics::Velocity& b = state.velocities[c.b];
    return {state.velocities[c.a], state.is_periodic() ? physics::at_image(b, physics::image_in(c, state.fixed())) : b};
}

// Read only where restitution is possible. `debt`: the contact's part of its bodies' debts.
physics::ImpactContext around_impact(const State& state, const physics::Constraint& c, float debt = 0) {
    if (!(c.restitution > 0)) return physics::no_impact_context();
    physics::ImpactContext around = physics::impact_context(c, state.forces[c.a], state.forces[c.b], state.masses[c.a],
                                                            state.masses[c.b], parameters_of(state, c.a));
    around.debt = debt;
    return around;
}

physics::Surface surface_on(const State& state, const physics::BodyProperties& row) {
    const physics::uint surface = physics::surface_of(row);
    return surface == 0 ? physics::plain_surface(row) : state.surfaces[surface - 1];
}

void write_deltas(State& state, const physics::Constraint& c, const physics::VelocityPair& delta, float weight, float passed_on) {
    if (c.slot_a != physics::NONE) state.slots[c.slot_a] = physics::velocity_delta(delta.a, weight, passed_on);
    if (c.slot_b != physics::NONE) state.slots[c.slot_b] = physics::velocity_delta(delta.b, weight, passed_on);
}

void show_quiet_steps_of(State& state, std::size_t i, bool has_surfaces) {
    const bool is_driven = has_surfaces && physics::is_driven(state.constraints[i]);
    const auto show = [&](std::uint32_t slot, std::uint32_t row_of_other) {
        if (slot == physics::NONE) return;
        const std::uint32_t other = state.body_of(row_of_other);
        state.neighbours_quiet[slot] = is_driven ? physics::BESIDE_MOVING
                                                 : physics::quiet_steps_shown(state.properties[other].motion,
                                                                              state.velocities[other], state.sleep_states[other]);
    };
    show(state.contact_slots[2 * i], state.contacts[i].b);
    show(state.contact_slots[2 * i + 1], state.contacts[i].a);
}

// Calls work(contact) for those of this pass.
template <class Work>
void for_each_solved(const State& state, const Threads& threads, const Work& work) {
    const std::uint32_t begin = state.passed_first();
    threads.for_each(state.passed_last() - begin, [&](std::size_t k) { work(state.contacts_to_solve[begin + k]); });
}

// Whether neither tyres nor surfaces take part.
bool is_ordinary(const State& state, const physics::Contact& contact) {
    const physics::BodyProperties &ta = state.properties[contact.a], &tb = state.properties[contact.b];
    return (physics::surface_of(ta) | physics::surface_of(tb) | physics::tyre_of(ta) | physics::tyre_of(tb)) == 0;
}

void prepare_constraint(State& state, std::size_t i) {
    const physics::Parameters& p = state.fixed();
    physics::Constraint& c = state.constraints[i];
    const physics::Contact& contact = state.contacts[i];
    const std::uint32_t a = c.a, b = c.b;
    const physics::BodyProperties &ta = state.properties[contact.a], &tb = state.properties[contact.b];
    c = physics::constraint_between(contact, ta, a, c.slot_a, tb, b, c.slot_b, parameters_of(state, a));
    c = physics::with_joints(c, state.properties[a].joints, state.properties[b].joints);
    if (state.is_periodic()) c = physics::meeting_image(c, image_met(state, contact.a, contact.b));
    if ((physics::surface_of(ta) | physics::surface_of(tb)) != 0)
        c = physics::with_surfaces(c, ta, surface_on(state, ta), state.poses[a].orientation, tb, surface_on(state, tb),
                                   state.poses[b].orientation, p);
    const physics::VelocityPair now = velocities_of(state, c);
    const bool tyre_is_a = physics::tyre_of(ta) != 0;
    if (const physics::uint tyre = physics::tyre_of(tyre_is_a ? ta : tb))
        c = physics::on_tyre(c, tyre_is_a, state.tyres[tyre - 1], contact.center_offset, now);
}

// ---- blocks of contacts (contact_block.h)

bool shares_block(const State& state, const physics::Contact& contact) {
    return physics::shares_block(state.properties[contact.a], state.properties[contact.b], state.fixed());
}

// The slots of the movable body of a contact that has fewer: all contacts of the pair are among them, in one order.
struct SlotsOfBody {
    std::uint32_t first, own, last;
    SlotsOfBody(const State& state, std::size_t contact) {
        const std::uint32_t slot_a = state.contact_slots[2 * contact], slot_b = state.contact_slots[2 * contact + 1];
        if (slot_a != physics::NONE) *this = of(state, state.body_of(state.contacts[contact].a), slot_a);
        if (slot_b == physics::NONE) return;
        const SlotsOfBody others = of(state, state.body_of(state.contacts[contact].b), slot_b);
        if (slot_a == physics::NONE || others.last - others.first < last - first) *this = others;
    }

private:
    SlotsOfBody() = default;
    static SlotsOfBody of(const State& state, std::uint32_t body, std::uint32_t own) {
        SlotsOfBody slots;
        slots.first = state.first_slot_of(body);
        slots.own = own;
        slots.last = state.slot_ends[body];
        return slots;
    }
};

// The contact in a slot if it belongs to the same pair of bodies and shares its block; else NONE.
std::uint32_t partner_in(const State& state, std::uint32_t slot, const physics::Contact& contact) {
    const std::uint32_t side = state.slot_sides[slot];
    if ((side & physics::OF_JOINT) != 0) return physics::NONE;
    const physics::Contact& other = state.contacts[side / 2];
    const bool partners = state.body_of(other.a) == state.body_of(contact.a) &&
                          state.body_of(other.b) == state.body_of(contact.b) && shares_block(state, other);
    return partners ? side / 2 : physics::NONE;
}

bool follows_another(const State& state, std::size_t i) {
    const SlotsOfBody slots(state, i);
    std::uint32_t before = 0;
    for (std::uint32_t slot = slots.first; slot < slots.own; ++slot)
        before += partner_in(state, slot, state.contacts[i]) != physics::NONE;
    return before % physics::BLOCK_CONTACTS != 0;
}
std::uint32_t next_partner(const State& state, std::size_t i) {
    const SlotsOfBody slots(state, i);
    for (std::uint32_t slot = slots.own + 1; slot < slots.last; ++slot)
        if (const std::uint32_t partner = partner_in(state, slot, state.contacts[i]); partner != physics::NONE) return partner;
    return physics::NONE;
}

// Calls work(contact, whether it is the last) for the contacts of a block, from its first or last one on.
template <class Work>
void for_each_of_block(const State& state, std::size_t begin, const Work& work) {
    physics::uint before = 0;
    for (physics::uint here = static_cast<physics::uint>(begin) + 1; here != 0;) {
        const physics::uint next = physics::next_of_block(state.constraints[here - 1], before);
        work(here - 1, next == 0);
        before = here;
        here = next;
    }
}

physics::BlockLoad load_of_block(const State& state, std::size_t first) {
    physics::BlockLoad load = physics::no_load();
    for_each_of_block(state, first,
                      [&](std::size_t i, bool) { load = physics::with_contact(load, state.constraints[i], state.impulse(i)); });
    return load;
}

// The weight of a block in mass splitting goes with its last contact.
float weight_of_block(float weight, bool is_last, float& of_block) {
    of_block = std::max(of_block, weight);
    return is_last ? of_block : 0;
}

void begin_constraint(State& state, std::size_t i) {
    physics::Constraint& c = state.constraints[i];
    c.a = state.body_of(state.contacts[i].a);
    c.b = state.body_of(state.contacts[i].b);
    c.slot_a = state.contact_slots[2 * i];
    c.slot_b = state.contact_slots[2 * i + 1];
}

// ---- the passes over a block; most have one contact

// The warm start of the first substep, of contacts whose constraints are prepared.
void hand_out_first(State& state, std::size_t first) {
    float of_block = 0;
    for_each_of_block(state, first, [&](std::size_t i, bool is_last) {
        const physics::Constraint& c = state.constraints[i];
        const physics::Impulse impulse = state.impulse(i);
        const physics::ContactShare share = physics::first_share(c, impulse, velocities_of(state, c), state.masses[c.a],
                                                                 state.masses[c.b], parameters_of(state, c.a));
        write_deltas(state, c, share.change, weight_of_block(share.weight, is_last, of_block), impulse.normal_sum);
    });
}

void prepare_block(State& state, std::size_t first) {
    physics::uint before = 0, here = static_cast<physics::uint>(first) + 1;
    for (std::uint32_t place = 1; here != 0; ++place) {
        const std::size_t i = here - 1;
        begin_constraint(state, i);
        prepare_constraint(state, i);
        const physics::uint next = place < physics::BLOCK_CONTACTS ? next_partner(state, i) + 1 : 0;  // NONE + 1 is 0
        state.constraints[i] = physics::linked(state.constraints[i], before, next);
        before = here;
        here = next;
    }
    hand_out_first(state, first);
}

void solve_block(State& state, std::size_t first) {
    const physics::Constraint& of_first = state.constraints[first];
    if (physics::follows_in_block(of_first)) return;
    const physics::BlockBodies bodies =
        physics::biased_bodies(state.masses[of_first.a], state.masses[of_first.b], state.impulse(first),
                               load_of_block(state, first), velocities_of(state, of_first), state.fixed());
    physics::VelocityPair v = bodies.moved;
    for_each_of_block(state, first, [&](std::size_t i, bool) {
        const physics::Constraint& c = state.constraints[i];
        const physics::BiasedOutcome after =
            physics::biased_pass(c, state.impulse(i), v, bodies, around_impact(state, c), parameters_of(state, c.a));
        state.keep_impulse(i, after.impulse);
        write_deltas(state, c, after.share, after.impact_weight, after.debt);
        v = after.velocity;
    });
}

void relax_block(State& state, std::size_t last_contact, std::uint32_t pass) {
    const physics::Constraint& of_last = state.constraints[last_contact];
    if (physics::leads_in_block(of_last)) return;
    const physics::BlockBodies bodies = physics::relax_bodies(
        state.masses[of_last.a], state.forces[of_last.a], state.masses[of_last.b], state.forces[of_last.b],
        state.impulse(last_contact), load_of_block(state, last_contact), velocities_of(state, of_last), state.fixed());
    physics::VelocityPair v = bodies.moved;
    float of_block = 0;
    for_each_of_block(state, last_contact, [&](std::size_t i, bool is_last) {
        const physics::Constraint& c = state.constraints[i];
        const physics::Impulse biased = state.impulse(i);
        const float debt = physics::part_of_debts(biased, state.impact_debts[c.a], state.forces[c.a], bodies.a,
                                                  state.impact_debts[c.b], state.forces[c.b], bodies.b);
        const physics::RelaxOutcome after = physics::relax_pass(c, biased, v, bodies, around_impact(state, c, debt),
                                                                (pass & physics::PASS_LAST) != 0, parameters_of(state, c.a));
        if ((pass & physics::PASS_SUMS) != 0)
            state.carried[i] = (pass & physics::PASS_FIRST) != 0 ? after.borne : state.carried[i] + after.borne;
        state.keep_impulse(i, after.impulse);
        write_deltas(state, c, after.share, weight_of_block(after.counts, is_last, of_block), after.normal_sum);
        v = after.velocity;
    });
}

}  // namespace

void prepare_contacts(State& state, const Threads& threads, std::uint32_t) {
    const WideStages* wide = wide_stages(threads.lanes());
    const bool sorted = wide || !state.presence.empty(), blocks = state.features().blocks;
    const bool in_lanes = wide && wide_tables(state, state.contacts_to_solve).warm_starts;
    const SolverClasses classes(state);
    if (sorted)
        state.scratch.solver_classes.resize(std::max<std::size_t>(state.scratch.solver_classes.size(), state.counted().contacts));
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        if (in_lanes && is_solved(state, i)) {
            state.scratch.solver_classes[i] = classes.of_warm_started(i);
            return;
        }
        const physics::Contact& contact = state.contacts[i];
        const std::uint32_t a = state.body_of(contact.a), b = state.body_of(contact.b);
        const bool idle = physics::is_idle(state.contact_slots[2 * i], state.contact_slots[2 * i + 1]);
        const bool follows = blocks && !idle && shares_block(state, contact) && follows_another(state, i);
        const bool leads = blocks && !idle && !follows && shares_block(state, contact) && next_partner(state, i) != physics::NONE;
        if (sorted)
            state.scratch.solver_classes[i] =
                idle ? not_solved : classes.of(a, b, contact, state.impulses[i].normal_sum > 0, follows || leads);
        if (follows) return;  // the first contact of its block prepares it
        physics::Constraint& c = state.constraints[i];
        begin_constraint(state, i);
        if (idle) {
            c = physics::idle_between(contact, a, b);
        } else if (leads) {
            prepare_block(state, i);
        } else if (wide && is_ordinary(state, contact)) {
            c.flags = 0;
        } else {
            prepare_constraint(state, i);
            if (!wide) hand_out_first(state, i);
        }
    });
    if (sorted) sort_contacts_to_solve(state, threads);
    if (!wide) return;
    make_room_for_groups(state, static_cast<std::size_t>(wide->lanes));
    for_each_group(state, threads, wide_tables(state, state.contacts_to_solve), *wide, wide->prepare, [](std::size_t) {});
}

void solve_contacts(State& state, const Threads& threads, std::uint32_t) {
    const auto alone = [&](std::size_t i) { solve_block(state, i); };
    if (const WideStages* wide = wide_stages(threads.lanes()))
        for_each_group(state, threads, wide_tables(state, state.contacts_to_solve), *wide, wide->solve, alone);
    else
        for_each_solved(state, threads, alone);
}

void relax_contacts(State& state, const Threads& threads, std::uint32_t pass) {
    const auto alone = [&](std::size_t i) { relax_block(state, i, pass); };
    if (const WideStages* wide = wide_stages(threads.lanes())) {
        WideTables tables = wide_tables(state, state.contacts_to_solve);
        if ((pass & physics::PASS_SUMS) != 0) tables.carried = state.carried.data();
        tables.first = (pass & physics::PASS_FIRST) != 0;
        tables.last = (pass & physics::PASS_LAST) != 0;
        for_each_group(state, threads, tables, *wide, wide->relax, alone);
    } else {
        for_each_solved(state, threads, alone);
    }
}

void show_quiet_steps(State& state, const Threads& threads, std::uint32_t) {
    if (state.fixed().sleep_steps == physics::NO_SLEEP) return;
    const bool has_surfaces = state.features().surfaces;
    for_each_solved(state, threads, [&](std::size_t i) { show_quiet_steps_of(state, i, has_surfaces); });
}

}  // namespace scree::reference
