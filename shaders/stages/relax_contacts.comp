// The pass without bias over all contacts that move somebody at once; it also hands out the next substep's warm start, or after
// the last one (push.pass 1) what each body tells the other of its rest.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void main() {
    if (thread() >= COUNTS.solved) return;
    uint i = binned.at[thread()];
    Constraint c = constraints.at[i];
    Impulse impulse = impulses.at[i];
    Mass ma = shared_for(impulse, masses.at[c.a], loads.at[c.a], PARAMETERS);
    Mass mb = shared_for(impulse, masses.at[c.b], loads.at[c.b], PARAMETERS);
    Couple before;
    before.a = velocities.at[c.a];
    before.b = velocities.at[c.b];
    vec3 pull = c.restitution > 0.0f ? pull_of(loads.at[c.a], loads.at[c.b]) : vec3(0.0f);
    Solved after = relaxed(c, impulse, before, ma, mb, pull, PARAMETERS);
    impulse = without_blows(after.impulse, c.count);
    impulse.pressed = pressing(impulse);
    impulses.at[i] = impulse;
    Couple share = shares_of(before, after.couple, ma, mb);
    float told_a = impulse.pressed, told_b = impulse.pressed;
    if (push.pass == 0u) {
        share = warm_start(c, impulse, share, ma, mb);
    } else {
        told_a = told_quiet(traits.at[c.a].motion, before.a, rests.at[c.a]);
        told_b = told_quiet(traits.at[c.b].motion, before.b, rests.at[c.b]);
    }
    float carrying = carries(c, impulse, after.couple, PARAMETERS);
    if (c.slot_a != NONE) slots.at[c.slot_a] = slot_of(share.a, carrying, told_b);
    if (c.slot_b != NONE) slots.at[c.slot_b] = slot_of(share.b, carrying, told_a);
}
