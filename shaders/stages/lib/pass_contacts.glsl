// The two passes of a substep over one contact of those that move somebody, `place` in their list.
#ifndef SCREE_STAGES_PASS_CONTACTS_GLSL
#define SCREE_STAGES_PASS_CONTACTS_GLSL

#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/contact_solver.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

// With bias.
void solve_contact(uint place) {
    if (place >= COUNTED.solved) return;
    uint i = READ_WORD(solved_contacts, place);
    Constraint c = narrowed(READ(constraints, i));
    Impulse impulse = narrowed(READ(impulses, i));
    Mass ma = lent(READ(masses, c.a), impulse, PARAMETERS);
    Mass mb = lent(READ(masses, c.b), impulse, PARAMETERS);
    Couple before;
    before.a = READ(velocities, c.a);
    before.b = READ(velocities, c.b);
    vec3 pull = c.restitution > 0.0f ? pull_of(READ(loads, c.a), READ(loads, c.b)) : vec3(0.0f);
    Solved after = solved(c, impulse, before, ma, mb, pull, PARAMETERS);
    impulses.at[i].normal = after.impulse.normal;
    if (BOUNCES) impulses.at[i].approach = after.impulse.approach;
    impulses.at[i].friction = after.impulse.friction;
    impulses.at[i].twist = after.impulse.twist;
    if (ROLLS) impulses.at[i].rolling = after.impulse.rolling;
    Couple share = shares_of(before, after.couple, ma, mb);
    float blow = blow_of(after.impulse);
    if (c.slot_a != NONE) slots.at[c.slot_a] = slot_of(share.a, blow, 0.0f);
    if (c.slot_b != NONE) slots.at[c.slot_b] = slot_of(share.b, blow, 0.0f);
}

const uint LAST_SUBSTEP = 1u, FIRST_SUBSTEP = 2u;

// Without bias. It also hands out the next substep's warm start, or after the last one what each body tells the other of its
// rest. Where bodies may break it also adds up what each contact carries in the step.
void relax_contact(uint place, uint pass) {
    if (place >= COUNTED.solved) return;
    uint i = READ_WORD(solved_contacts, place);
    Constraint c = narrowed(READ(constraints, i));
    Impulse impulse = narrowed(READ(impulses, i));
    Mass ma = shared_for(impulse, READ(masses, c.a), READ(loads, c.a), PARAMETERS);
    Mass mb = shared_for(impulse, READ(masses, c.b), READ(loads, c.b), PARAMETERS);
    Couple before;
    before.a = READ(velocities, c.a);
    before.b = READ(velocities, c.b);
    vec3 pull = c.restitution > 0.0f ? pull_of(READ(loads, c.a), READ(loads, c.b)) : vec3(0.0f);
    Solved after = relaxed(c, impulse, before, ma, mb, pull, PARAMETERS);
    if (BREAKING) {
        float sum = pressing(after.impulse);
        if ((pass & FIRST_SUBSTEP) == 0u) sum = uintBitsToFloat(WORD(carried, i)) + sum;
        SET_FLOAT(carried, i, sum);
    }
    impulse = without_blows(after.impulse, c.count);
    impulse.pressed = pressing(impulse);
    impulses.at[i].normal = impulse.normal;
    impulses.at[i].separation = impulse.separation;
    impulses.at[i].friction = impulse.friction;
    impulses.at[i].twist = impulse.twist;
    if (ROLLS) impulses.at[i].rolling = impulse.rolling;
    impulses.at[i].slipped = impulse.slipped;
    impulses.at[i].d = impulse.d;
    impulses.at[i].pressed = impulse.pressed;
    Couple share = shares_of(before, after.couple, ma, mb);
    float told_a = impulse.pressed, told_b = impulse.pressed;
    if ((pass & LAST_SUBSTEP) == 0u) {
        share = warm_start(c, impulse, share, ma, mb);
    } else {
        told_a = told_quiet(READ(traits, c.a).motion, before.a, READ_WORD(rests, c.a));
        told_b = told_quiet(READ(traits, c.b).motion, before.b, READ_WORD(rests, c.b));
    }
    float carrying = carries(c, impulse, after.couple, PARAMETERS);
    if (c.slot_a != NONE) slots.at[c.slot_a] = slot_of(share.a, carrying, told_b);
    if (c.slot_b != NONE) slots.at[c.slot_b] = slot_of(share.b, carrying, told_a);
}

#endif
