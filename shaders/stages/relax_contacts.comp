// The pass without bias over all contacts at once; it also hands out the next substep's warm start (push.pass 1: there is none).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts) return;
    Constraint c = constraints[i];
    Impulse impulse = impulses[i];
    Mass ma = shared_for(impulse, masses[c.a], loads[c.a]);
    Mass mb = shared_for(impulse, masses[c.b], loads[c.b]);
    Couple before;
    before.a = velocities[c.a];
    before.b = velocities[c.b];
    vec3 pull = c.restitution > 0.0f ? pull_of(loads[c.a], loads[c.b]) : vec3(0.0f);
    Solved after = relaxed(c, impulse, before, ma, mb, pull, PARAMETERS);
    impulse = without_blows(after.impulse, c.count);
    impulses[i] = impulse;
    Couple share = shares_of(before, after.couple, ma, mb);
    if (push.pass == 0u) share = warm_start(c, impulse, share, ma, mb);
    float carrying = carries(c, impulse, after.couple, PARAMETERS);
    if (c.slot_a != NONE) slots[c.slot_a] = slot_of(share.a, carrying);
    if (c.slot_b != NONE) slots[c.slot_b] = slot_of(share.b, carrying);
}
