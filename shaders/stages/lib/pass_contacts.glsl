// The biased and the relax pass over one block of contacts (contact_block.h); `place` in contacts_to_solve.
#ifndef SCREE_STAGES_PASS_CONTACTS_GLSL
#define SCREE_STAGES_PASS_CONTACTS_GLSL

#include "shaders/physics/base/passes.h"
#include "shaders/physics/body/periodic_cell.h"
#include "shaders/physics/contact/contact_pass.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/impulses.glsl"

ImpactContext around_impact(Constraint c) {
    if (!(c.restitution > 0.0f)) return no_impact_context();
    return impact_context(c, READ(forces, c.a), READ(forces, c.b), READ(masses, c.a), READ(masses, c.b), parameters_of(c.a));
}
VelocityPair velocities_of(Constraint c) {
    VelocityPair v;
    v.a = READ(velocities, c.a);
    v.b = READ(velocities, c.b);
    if (PERIODIC) v.b = at_image(v.b, image_in(c, PARAMETERS));
    return v;
}
void write_slots(Constraint c, VelocityPair share, float weight, float passed_on) {
    if (c.slot_a != NONE) WRITE(slots, c.slot_a, velocity_delta(share.a, weight, passed_on));
    if (c.slot_b != NONE) WRITE(slots, c.slot_b, velocity_delta(share.b, weight, passed_on));
}

// Of the contact with which a pass over a block begins, and of those that come after it.
BlockLoad load_of_block(uint i, Constraint c, Impulse impulse) {
    BlockLoad load = with_contact(no_load(), c, impulse);
    if (!BLOCKS) return load;
    uint before = i + 1u;
    for (uint here = next_of_block(c, 0u); here != 0u;) {
        c = READ_GROUPED(constraints, here - 1u);
        load = with_contact(load, c, impulse_at(here - 1u));
        uint next = next_of_block(c, before);
        before = here;
        here = next;
    }
    return load;
}

// What the biased pass changes, but for rolling resistance.
const uint SOLVED_MEMBERS =
    MEMBER_OF_ContactImpulse_normal | MEMBER_OF_ContactImpulse_friction | MEMBER_OF_ContactImpulse_stretch;

// The biased pass.
void solve_contact(uint place) {
    if (place >= COUNTED.solver_contacts) return;
    uint i = READ_WORD(contacts_to_solve, place);
    Constraint c = narrowed(READ_GROUPED(constraints, i));
    if (BLOCKS && follows_in_block(c)) return;
    Impulse impulse = impulse_at(i);
    BlockBodies bodies =
        biased_bodies(READ(masses, c.a), READ(masses, c.b), impulse, load_of_block(i, c, impulse), velocities_of(c), PARAMETERS);
    if (!BLOCKS) bodies.part = 1.0f;
    VelocityPair v = bodies.moved;
    uint came_from = 0u;
    uint here = i + 1u;
    do {
        if (came_from != 0u) {
            c = narrowed(READ_GROUPED(constraints, here - 1u));
            impulse = impulse_at(here - 1u);
        }
        BiasedOutcome after = biased_pass(c, impulse, v, bodies, around_impact(c), parameters_of(c.a));
        write_impulses(here - 1u, contact_impulse_of(after.impulse),
                       SOLVED_MEMBERS | (ROLLS ? MEMBER_OF_ContactImpulse_rolling : 0u));
        if (BOUNCES) write_impacts(here - 1u, contact_impact_of(after.impulse), EVERY_MEMBER);
        write_slots(c, after.share, after.impact_weight, BOUNCES ? after.debt : 0.0f);
        v = after.velocity;
        uint next = next_of_block(c, came_from);
        came_from = here;
        here = next;
    } while (BLOCKS && here != 0u);
}

// The relax pass, from the last contact of the block to the first. It also writes the next substep's warm start, and sums
// the contacts' impulses over the step where bodies may break.
void relax_contact(uint place, uint pass) {
    if (place >= COUNTED.solver_contacts) return;
    uint i = READ_WORD(contacts_to_solve, place);
    Constraint c = narrowed(READ_GROUPED(constraints, i));
    if (BLOCKS && leads_in_block(c)) return;
    Impulse impulse = impulse_at(i);
    BlockBodies bodies = relax_bodies(READ(masses, c.a), READ(forces, c.a), READ(masses, c.b), READ(forces, c.b), impulse,
                                      load_of_block(i, c, impulse), velocities_of(c), PARAMETERS);
    if (!BLOCKS) bodies.part = 1.0f;
    bool last = (pass & PASS_LAST) != 0u;
    VelocityPair v = bodies.moved;
    float weight = 0.0f;  // of the block in mass splitting, so far
    uint came_from = 0u;
    uint here = i + 1u;
    do {
        if (came_from != 0u) {
            c = narrowed(READ_GROUPED(constraints, here - 1u));
            impulse = impulse_at(here - 1u);
        }
        ImpactContext around = around_impact(c);
        if (BOUNCES && is_impact(impulse))
            around.debt = part_of_debts(impulse, READ_FLOAT(impact_debts, c.a), READ(forces, c.a), bodies.a,
                                        READ_FLOAT(impact_debts, c.b), READ(forces, c.b), bodies.b);
        RelaxOutcome after = relax_pass(c, impulse, v, bodies, around, last, parameters_of(c.a));
        if (SUMS) {
            float before = (pass & PASS_FIRST) != 0u ? 0.0f : uintBitsToFloat(WORD(carried, here - 1u));
            SET_FLOAT(carried, here - 1u, (pass & PASS_FIRST) != 0u ? after.borne : before + after.borne);
        }
        keep_impulse(here - 1u, after.impulse);
        v = after.velocity;
        weight = larger(weight, after.counts);
        uint next = next_of_block(c, came_from);
        write_slots(c, after.share, next == 0u ? weight : 0.0f, after.normal_sum);  // the weight of the whole block
        came_from = here;
        here = next;
    } while (BLOCKS && here != 0u);
}

#endif
