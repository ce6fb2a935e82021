// variants: predict_impacts -DWITHOUT_CONVEX
// variants: predict_impacts_convex -DWITH_CONVEX
// Continuous collision: predicts for the speculative contacts of fast pairs which will be impacts, and which are
// doubtful because the two pass each other or meet elsewhere.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/extra/time_of_impact.h"
#include "shaders/stages/lib/shape_data.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs || WORD(point_counts, i) == 0u) return;
    uint a = READ(pairs, i).a, b = READ(pairs, i).b;
    uint of_a = body_of(a), of_b = body_of(b);
    BodyProperties ta = READ(properties, a), tb = READ(properties, b);
    Velocity va = READ(velocities, a), vb = READ(velocities, b);
    if (!will_be_fast(READ(properties, of_a), READ(velocities, of_a), PARAMETERS) &&
        !will_be_fast(READ(properties, of_b), READ(velocities, of_b), PARAMETERS))
        return;
    vec3 normal = READ(manifolds, i).normal;
    if (!is_near(READ(manifolds, i), WORD(point_counts, i), PARAMETERS) &&
        !will_meet(normal, ta, READ(poses, a), va, READ(forces, of_a), tb, READ(poses, b), vb, READ(forces, of_b), PARAMETERS,
                   Hulls(0u))) {
        WORD(point_counts, i) = WORD(point_counts, i) | SPECULATIVE;
        return;
    }
    uint struck = is_impacting(normal, va, vb) ? STRUCK : 0u;
    uint flags_a = struck | (drives(READ(properties, of_b), READ(velocities, of_b), PARAMETERS) ? DRIVEN : 0u);
    uint flags_b = struck | (drives(READ(properties, of_a), READ(velocities, of_a), PARAMETERS) ? DRIVEN : 0u);
    if (flags_a != 0u) atomicOr(bounds.at[of_a].sweep.struck, flags_a);
    if (flags_b != 0u) atomicOr(bounds.at[of_b].sweep.struck, flags_b);
}
