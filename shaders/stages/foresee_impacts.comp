// Drops the contacts ahead of fast pairs that will pass each other, or touch elsewhere: these are stopped where they come to touch.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/impact.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.pairs || touching[i] == 0u) return;
    uint a = pairs[i].a, b = pairs[i].b;
    Traits ta = traits[a], tb = traits[b];
    Velocity va = velocities[a], vb = velocities[b];
    if (!will_be_fast(ta, va, PARAMETERS) && !will_be_fast(tb, vb, PARAMETERS)) return;
    if (is_near(manifolds[i], touching[i], PARAMETERS)) return;
    if (!will_meet(manifolds[i].normal, ta, poses[a], va, loads[a], tb, poses[b], vb, loads[b], PARAMETERS)) touching[i] = 0u;
}
