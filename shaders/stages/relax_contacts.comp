// variants: relax_contacts -DWITHOUT_FRACTURES
// variants: relax_contacts_felt -DWITH_FRACTURES
// The pass without bias over all contacts that move somebody at once; it also hands out the next substep's warm start, or after
// the last one (bit 0 of push.pass) what each body tells the other of its rest. Where bodies may break it also adds up what each
// contact carries in the step, from the first substep (bit 1) to the last.
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
#ifdef WITH_FRACTURES
    float carried = pressing(after.impulse);
    if ((push.pass & 2u) == 0u) carried = uintBitsToFloat(candidates.at[i].owner) + carried;
    candidates.at[i].owner = floatBitsToUint(carried);
#endif
    impulse = without_blows(after.impulse, c.count);
    impulse.pressed = pressing(impulse);
    impulses.at[i] = impulse;
    Couple share = shares_of(before, after.couple, ma, mb);
    float told_a = impulse.pressed, told_b = impulse.pressed;
    if ((push.pass & 1u) == 0u) {
        share = warm_start(c, impulse, share, ma, mb);
    } else {
        told_a = told_quiet(traits.at[c.a].motion, before.a, rests.at[c.a]);
        told_b = told_quiet(traits.at[c.b].motion, before.b, rests.at[c.b]);
    }
    float carrying = carries(c, impulse, after.couple, PARAMETERS);
    if (c.slot_a != NONE) slots.at[c.slot_a] = slot_of(share.a, carrying, told_b);
    if (c.slot_b != NONE) slots.at[c.slot_b] = slot_of(share.b, carrying, told_a);
}
