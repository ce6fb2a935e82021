// The biased pass over all contacts that move somebody at once.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/stages/content.glsl"
#include "shaders/stages/stage.glsl"

void main() {
    if (thread() >= COUNTED.solved) return;
    uint i = READ(binned, thread());
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
