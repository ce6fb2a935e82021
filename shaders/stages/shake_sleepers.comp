// Passes on how deep bodies shake others from those who do so exactly push.pass deep; no later round changes these any more.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void shake(uint by, uint other) {
    if (shakes(rests.at[by], push.pass) && traits.at[other].motion == MOTION_DYNAMIC)
        atomicOr(rests.at[other], shaking_bit(push.pass - 1u));
}

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts) return;
    Pair pair = pairs.at[constraints.at[i].pair];
    shake(pair.a, pair.b);
    shake(pair.b, pair.a);
}
