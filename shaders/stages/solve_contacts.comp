// The biased pass over all contacts that move somebody at once.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/stages/stage.glsl"

void main() {
    if (thread() >= COUNTS.solved) return;
    uint i = binned.at[thread()];
    Constraint c = constraints.at[i];
    Impulse impulse = impulses.at[i];
    Mass ma = lent(masses.at[c.a], impulse, PARAMETERS);
    Mass mb = lent(masses.at[c.b], impulse, PARAMETERS);
    Couple before;
    before.a = velocities.at[c.a];
    before.b = velocities.at[c.b];
    vec3 pull = c.restitution > 0.0f ? pull_of(loads.at[c.a], loads.at[c.b]) : vec3(0.0f);
    Solved after = solved(c, impulse, before, ma, mb, pull, PARAMETERS);
    impulses.at[i] = after.impulse;
    Couple share = shares_of(before, after.couple, ma, mb);
    float blow = blow_of(after.impulse);
    if (c.slot_a != NONE) slots.at[c.slot_a] = slot_of(share.a, blow, 0.0f);
    if (c.slot_b != NONE) slots.at[c.slot_b] = slot_of(share.b, blow, 0.0f);
}
