// The biased and the relax pass over one block of contacts (contact_block.h); `place` in contacts_to_solve.
#ifndef SCREE_STAGES_PASS_CONTACTS_GLSL
#define SCREE_STAGES_PASS_CONTACTS_GLSL

#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/contact_block.h"
#include "shaders/physics/solve/contact_solver.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/impulses.glsl"

vec4 state_of_impacts(Constraint c) {
    if (!(c.restitution > 0.0f)) return vec4(0.0f);
    return impact_state(READ(forces, c.a), READ(forces, c.b), READ(masses, c.a), READ(masses, c.b), felt_by(c.a));
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

// The biased pass over one contact of a block; returns the velocities of the split bodies.
VelocityPair solve_one(uint i, Constraint c, Impulse impulse, VelocityPair before, Mass ma, Mass mb, float part) {
    vec4 state = state_of_impacts(c);
    SolveResult after = solve_contact(c, impulse, before, ma, mb, state, part, felt_by(c.a));
    write_impulses(i, contact_impulse_of(after.impulse), SOLVED_MEMBERS | (ROLLS ? MEMBER_OF_ContactImpulse_rolling : 0u));
    if (BOUNCES) write_impacts(i, contact_impact_of(after.impulse), EVERY_MEMBER);
    VelocityPair share = to_body_deltas(before, after.pair_velocity, ma, mb);
    float blow = after.impulse.impact_weight;
    float debt = BOUNCES ? impact_debt(after.impulse) : 0.0f;
    if (c.slot_a != NONE) slots.at[c.slot_a] = velocity_delta(share.a, blow, debt);
    if (c.slot_b != NONE) slots.at[c.slot_b] = velocity_delta(share.b, blow, debt);
    return after.pair_velocity;
}

// The biased pass.
void solve_contact(uint place) {
    if (place >= COUNTED.solver_contacts) return;
    uint i = READ_WORD(contacts_to_solve, place);
    Constraint c = narrowed(READ_GROUPED(constraints, i));
    if (BLOCKS && follows_in_block(c)) return;
    Impulse impulse = impulse_at(i);
    BlockLoad load = load_of_block(i, c, impulse);
    Impulse lent = impulse;
    lent.normal_sum = load.normal_sum;
    Mass ma = split_mass(READ(masses, c.a), lent, PARAMETERS);
    Mass mb = split_mass(READ(masses, c.b), lent, PARAMETERS);
    float part = BLOCKS ? part_of_stiffness(load) : 1.0f;
    VelocityPair before;
    before.a = READ(velocities, c.a);
    before.b = READ(velocities, c.b);
    uint came_from = 0u;
    for (uint here = i + 1u; here != 0u;) {
        if (came_from != 0u) {
            c = narrowed(READ_GROUPED(constraints, here - 1u));
            impulse = impulse_at(here - 1u);
        }
        uint next = next_of_block(c, came_from);
        before = solve_one(here - 1u, c, impulse, before, ma, mb, part);
        came_from = here;
        here = next;
    }
}

// Each body's quiet steps, for the other's sleep.
void show_quiet_steps(Constraint c, VelocityPair before) {
    float quiet_a = quiet_steps_shown(READ(properties, c.a).motion, before.a, READ_WORD(sleep_states, c.a));
    float quiet_b = quiet_steps_shown(READ(properties, c.b).motion, before.b, READ_WORD(sleep_states, c.b));
    if (is_driven(c)) quiet_a = quiet_b = BESIDE_MOVING;
    if (c.slot_a != NONE) SET_FLOAT(neighbours_quiet, c.slot_a, quiet_b);
    if (c.slot_b != NONE) SET_FLOAT(neighbours_quiet, c.slot_b, quiet_a);
}

const uint LAST_SUBSTEP = 1u, FIRST_SUBSTEP = 2u;

struct Relaxed {
    VelocityPair velocity;  // of the split bodies
    float weight;           // of the block in mass splitting, so far
};
// The relax pass over one contact of a block. It also writes the next substep's warm start, or in the last substep the quiet
// steps of either body for the other, and sums the contact's impulse over the step where bodies may break. `moved`: the
// velocities of the whole bodies.
Relaxed relax_one(uint i, Constraint c, Impulse impulse, Relaxed block, bool is_last, VelocityPair moved, Mass ma, Mass mb,
                  float part, uint pass) {
    VelocityPair before = block.velocity;
    vec4 state = state_of_impacts(c);
    float debt = 0.0f;
    if (BOUNCES && is_impact(impulse))
        debt = part_of_debts(impulse, READ_FLOAT(impact_debts, c.a), READ(forces, c.a), ma, READ_FLOAT(impact_debts, c.b),
                             READ(forces, c.b), mb);
    SolveResult after = relax_contact(c, impulse, moved, before, ma, mb, state, debt, part,
                                      (pass & LAST_SUBSTEP) != 0u ? 1.0f : 0.0f, felt_by(c.a));
    if (SUMS) {
        float sum = solved_impulse(after.impulse);
        if ((pass & FIRST_SUBSTEP) == 0u) sum = uintBitsToFloat(WORD(carried, i)) + sum;
        SET_FLOAT(carried, i, sum);
    }
    Impulse biased = impulse;
    impulse = clear_impacts(after.impulse, point_count(c));
    impulse.normal_sum = normal_impulse(impulse);
    keep_impulse(i, impulse);
    VelocityPair share = to_body_deltas(before, after.pair_velocity, ma, mb);
    if ((pass & LAST_SUBSTEP) == 0u)
        share = warm_start(c, impulse, share, ma, mb);
    else
        show_quiet_steps(c, moved);
    block.velocity = after.pair_velocity;
    block.weight = larger(block.weight, counts_next(c, biased, impulse, after.pair_velocity, ma, mb, felt_by(c.a)));
    float weight = is_last ? block.weight : 0.0f;  // that of the whole block
    if (c.slot_a != NONE) slots.at[c.slot_a] = velocity_delta(share.a, weight, impulse.normal_sum);
    if (c.slot_b != NONE) slots.at[c.slot_b] = velocity_delta(share.b, weight, impulse.normal_sum);
    return block;
}

// The relax pass, from the last contact of the block to the first.
void relax_contact(uint place, uint pass) {
    if (place >= COUNTED.solver_contacts) return;
    uint i = READ_WORD(contacts_to_solve, place);
    Constraint c = narrowed(READ_GROUPED(constraints, i));
    if (BLOCKS && leads_in_block(c)) return;
    Impulse impulse = impulse_at(i);
    Impulse lent = impulse;
    BlockLoad load = load_of_block(i, c, impulse);
    lent.normal_sum = load.normal_sum;
    float part = BLOCKS ? part_of_stiffness(load) : 1.0f;
    Mass ma = impact_mass(lent, READ(masses, c.a), READ(forces, c.a), PARAMETERS);
    Mass mb = impact_mass(lent, READ(masses, c.b), READ(forces, c.b), PARAMETERS);
    VelocityPair moved;
    moved.a = READ(velocities, c.a);
    moved.b = READ(velocities, c.b);
    Relaxed block;
    block.velocity = moved;
    block.weight = 0.0f;
    uint came_from = 0u;
    for (uint here = i + 1u; here != 0u;) {
        if (came_from != 0u) {
            c = narrowed(READ_GROUPED(constraints, here - 1u));
            impulse = impulse_at(here - 1u);
        }
        uint next = next_of_block(c, came_from);
        block = relax_one(here - 1u, c, impulse, block, next == 0u, moved, ma, mb, part, pass);
        came_from = here;
        here = next;
    }
}

#endif
