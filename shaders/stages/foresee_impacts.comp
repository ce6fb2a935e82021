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
    if (i >= COUNTS.pairs || touching[i] == 0u) return;
    uint a = pairs[i].a, b = pairs[i].b;
    uint of_a = body_of(a), of_b = body_of(b);
    Traits ta = traits[a], tb = traits[b];
    Velocity va = velocities[a], vb = velocities[b];
    if (!will_be_fast(traits[of_a], velocities[of_a], PARAMETERS) && !will_be_fast(traits[of_b], velocities[of_b], PARAMETERS))
        return;
    vec3 normal = manifolds[i].normal;
    if (!is_near(manifolds[i], touching[i], PARAMETERS) &&
        !will_meet(normal, ta, poses[a], va, loads[of_a], tb, poses[b], vb, loads[of_b], PARAMETERS, Hulls(0u))) {
        touching[i] = touching[i] | DOUBTFUL;
    } else if (is_blow(normal, va, vb, PARAMETERS)) {
        atomicOr(bounds[of_a].flight.struck, 1u);
        atomicOr(bounds[of_b].flight.struck, 1u);
    }
}
