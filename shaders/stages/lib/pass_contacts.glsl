// The biased and the relax pass over one solver contact, `place` in contacts_to_solve.
#ifndef SCREE_STAGES_PASS_CONTACTS_GLSL
#define SCREE_STAGES_PASS_CONTACTS_GLSL

#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/contact_solver.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/features.glsl"

vec4 state_of_impacts(Constraint c) {
    if (!(c.restitution > 0.0f)) return vec4(0.0f);
    return impact_state(READ(forces, c.a), READ(forces, c.b), READ(masses, c.a), READ(masses, c.b), felt_by(c.a));
}

// The biased pass.
void solve_contact(uint place) {
    if (place >= COUNTED.solver_contacts) return;
    uint i = READ_WORD(contacts_to_solve, place);
    Constraint c = narrowed(READ(constraints, i));
    Impulse impulse = narrowed(READ(impulses, i));
    Mass ma = split_mass(READ(masses, c.a), impulse, PARAMETERS);
    Mass mb = split_mass(READ(masses, c.b), impulse, PARAMETERS);
    VelocityPair before;
    before.a = READ(velocities, c.a);
    before.b = READ(velocities, c.b);
    vec4 state = state_of_impacts(c);
    SolveResult after = solve_contact(c, impulse, before, ma, mb, state, felt_by(c.a));
    impulses.at[i].normal = after.impulse.normal;
    if (BOUNCES) {
        impulses.at[i].impact = after.impulse.impact;
        impulses.at[i].rebound_energy = after.impulse.rebound_energy;
        impulses.at[i].impact_energy = after.impulse.impact_energy;
        impulses.at[i].impact_weight = after.impulse.impact_weight;
        impulses.at[i].flight_energy = after.impulse.flight_energy;
    }
    impulses.at[i].friction = after.impulse.friction;
    impulses.at[i].twist = after.impulse.twist;
    impulses.at[i].stretch = after.impulse.stretch;
    impulses.at[i].turn = after.impulse.turn;
    if (ROLLS) impulses.at[i].rolling = after.impulse.rolling;
    VelocityPair share = to_body_deltas(before, after.pair_velocity, ma, mb);
    float blow = after.impulse.impact_weight;
    float debt = BOUNCES ? impact_debt(after.impulse) : 0.0f;
    if (c.slot_a != NONE) slots.at[c.slot_a] = velocity_delta(share.a, blow, debt);
    if (c.slot_b != NONE) slots.at[c.slot_b] = velocity_delta(share.b, blow, debt);
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

// The relax pass. It also writes the next substep's warm start, or in the last substep the quiet steps of either body
// for the other, and sums the contact's impulse over the step where bodies may break.
void relax_contact(uint place, uint pass) {
    if (place >= COUNTED.solver_contacts) return;
    uint i = READ_WORD(contacts_to_solve, place);
    Constraint c = narrowed(READ(constraints, i));
    Impulse impulse = narrowed(READ(impulses, i));
    Mass ma = impact_mass(impulse, READ(masses, c.a), READ(forces, c.a), PARAMETERS);
    Mass mb = impact_mass(impulse, READ(masses, c.b), READ(forces, c.b), PARAMETERS);
    VelocityPair before;
    before.a = READ(velocities, c.a);
    before.b = READ(velocities, c.b);
    vec4 state = state_of_impacts(c);
    float debt = 0.0f;
    if (BOUNCES && is_impact(impulse))
        debt = part_of_debts(impulse, READ_FLOAT(impact_debts, c.a), READ(forces, c.a), ma, READ_FLOAT(impact_debts, c.b),
                             READ(forces, c.b), mb);
    SolveResult after = relax_contact(c, impulse, before, ma, mb, state, debt, felt_by(c.a));
    if (SUMS) {
        float sum = solved_impulse(after.impulse);
        if ((pass & FIRST_SUBSTEP) == 0u) sum = uintBitsToFloat(WORD(carried, i)) + sum;
        SET_FLOAT(carried, i, sum);
    }
    Impulse biased = impulse;
    impulse = clear_impacts(after.impulse, point_count(c));
    impulse.normal_sum = normal_impulse(impulse);
    impulses.at[i].normal = impulse.normal;
    impulses.at[i].solved_normal = impulse.solved_normal;
    impulses.at[i].separation = impulse.separation;
    if (BOUNCES) {
        impulses.at[i].impact = impulse.impact;
        impulses.at[i].rebound_energy = impulse.rebound_energy;
        impulses.at[i].impact_energy = impulse.impact_energy;
        impulses.at[i].impact_weight = impulse.impact_weight;
        impulses.at[i].flight_energy = impulse.flight_energy;
    }
    impulses.at[i].friction = impulse.friction;
    impulses.at[i].twist = impulse.twist;
    impulses.at[i].stretch = impulse.stretch;
    impulses.at[i].turn = impulse.turn;
    if (ROLLS) impulses.at[i].rolling = impulse.rolling;
    impulses.at[i].slide_distance = impulse.slide_distance;
    impulses.at[i].center_offset = impulse.center_offset;
    impulses.at[i].normal_sum = impulse.normal_sum;
    VelocityPair share = to_body_deltas(before, after.pair_velocity, ma, mb);
    if ((pass & LAST_SUBSTEP) == 0u)
        share = warm_start(c, impulse, share, ma, mb);
    else
        show_quiet_steps(c, before);
    float weight = counts_next(c, biased, impulse, after.pair_velocity, ma, mb, felt_by(c.a));
    if (c.slot_a != NONE) slots.at[c.slot_a] = velocity_delta(share.a, weight, impulse.normal_sum);
    if (c.slot_b != NONE) slots.at[c.slot_b] = velocity_delta(share.b, weight, impulse.normal_sum);
}

#endif
