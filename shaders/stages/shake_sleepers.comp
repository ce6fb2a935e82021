// Shakes the sleepers behind those whose waking goes exactly push.pass contacts deep; no later round changes these any more.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void shake(uint by, uint sleeper) {
    uint rest = rests[sleeper];
    if (shaking(rests[by]) != push.pass || !has_slept(rest, PARAMETERS.sleep_steps)) return;
    atomicMax(rests[sleeper], shaken(rest, push.pass - 1u));
}

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts) return;
    Pair pair = pairs[constraints[i].pair];
    shake(pair.a, pair.b);
    shake(pair.b, pair.a);
}
