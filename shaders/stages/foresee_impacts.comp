// variants: foresee_impacts -DWITHOUT_CONVEX
// variants: foresee_impacts_convex -DWITH_CONVEX
// Looks ahead for the contacts of fast pairs: which will strike their bodies, and which are doubtful because the two pass each
// other or touch elsewhere.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/impact.h"
#include "shaders/stages/hulls.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.pairs || touching.at[i] == 0u) return;
    uint a = pairs.at[i].a, b = pairs.at[i].b;
    Traits ta = traits.at[a], tb = traits.at[b];
    Velocity va = velocities.at[a], vb = velocities.at[b];
    if (!will_be_fast(ta, va, PARAMETERS) && !will_be_fast(tb, vb, PARAMETERS)) return;
    vec3 normal = manifolds.at[i].normal;
    if (!is_near(manifolds.at[i], touching.at[i], PARAMETERS) &&
        !will_meet(normal, ta, poses.at[a], va, loads.at[a], tb, poses.at[b], vb, loads.at[b], PARAMETERS, Hulls(0u))) {
        touching.at[i] = touching.at[i] | DOUBTFUL;
    } else if (is_blow(normal, va, vb, PARAMETERS)) {
        atomicOr(bounds.at[a].flight.struck, 1u);
        atomicOr(bounds.at[b].flight.struck, 1u);
    }
}
