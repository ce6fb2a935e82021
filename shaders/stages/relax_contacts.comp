// variants: relax_contacts -DWITHOUT_FRACTURES
// variants: relax_contacts_felt -DWITH_FRACTURES
// The pass without bias over all contacts that move somebody at once; it also hands out the next substep's warm start, or after
// the last one (bit 0 of push.pass) what each body tells the other of its rest. Where bodies may break it also adds up what each
// contact carries in the step, from the first substep (bit 1) to the last.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/content.glsl"
#include "shaders/stages/stage.glsl"

void main() {
    if (thread() >= COUNTED.solved) return;
    uint i = READ(binned, thread());
    Constraint c = narrowed(READ(constraints, i));
    Impulse impulse = narrowed(READ(impulses, i));
    Mass ma = shared_for(impulse, READ(masses, c.a), READ(loads, c.a), PARAMETERS);
    Mass mb = shared_for(impulse, READ(masses, c.b), READ(loads, c.b), PARAMETERS);
    Couple before;
    before.a = READ(velocities, c.a);
    before.b = READ(velocities, c.b);
    vec3 pull = c.restitution > 0.0f ? pull_of(READ(loads, c.a), READ(loads, c.b)) : vec3(0.0f);
    Solved after = relaxed(c, impulse, before, ma, mb, pull, PARAMETERS);
#ifdef WITH_FRACTURES
    float carried = pressing(after.impulse);
    if ((push.pass & 2u) == 0u) carried = uintBitsToFloat(candidates.at[i].owner) + carried;
    candidates.at[i].owner = floatBitsToUint(carried);
#endif
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
    if ((push.pass & 1u) == 0u) {
        share = warm_start(c, impulse, share, ma, mb);
    } else {
        told_a = told_quiet(READ(traits, c.a).motion, before.a, READ(rests, c.a));
        told_b = told_quiet(READ(traits, c.b).motion, before.b, READ(rests, c.b));
    }
    float carrying = carries(c, impulse, after.couple, PARAMETERS);
    if (c.slot_a != NONE) slots.at[c.slot_a] = slot_of(share.a, carrying, told_b);
    if (c.slot_b != NONE) slots.at[c.slot_b] = slot_of(share.b, carrying, told_a);
}
