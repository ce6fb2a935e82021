// The biased pass over all contacts that move somebody at once.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/stages/stage.glsl"

void main() {
    if (thread() >= COUNTS.solved) return;
    uint i = binned[thread()];
    Constraint c = constraints[i];
    Impulse impulse = impulses[i];
    Mass ma = lent(masses[c.a], impulse, PARAMETERS);
    Mass mb = lent(masses[c.b], impulse, PARAMETERS);
    Couple before;
    before.a = velocities[c.a];
    before.b = velocities[c.b];
    vec3 pull = c.restitution > 0.0f ? pull_of(loads[c.a], loads[c.b]) : vec3(0.0f);
    Solved after = solved(c, impulse, before, ma, mb, pull, PARAMETERS);
    impulses[i] = after.impulse;
    Couple share = shares_of(before, after.couple, ma, mb);
    float blow = blow_of(after.impulse);
    if (c.slot_a != NONE) slots[c.slot_a] = slot_of(share.a, blow, 0.0f);
    if (c.slot_b != NONE) slots[c.slot_b] = slot_of(share.b, blow, 0.0f);
}
