// variants: find_impacts -DWITHOUT_CONVEX
// variants: find_impacts_convex -DWITH_CONVEX
// Finds where the fast bodies must be stopped so that no pair passes through each other. push.pass is the round: in the first the
// ways are whole, in later ones those end that the round before has stopped, lest whoever follows runs into them.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/impact.h"
#include "shaders/stages/hulls.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.pairs) return;
    uint now = push.pass & 1u, next = now ^ 1u;
    uint a = pairs.at[i].a, b = pairs.at[i].b;
    uint bits_a = bounds.at[a].flight.stops[now], bits_b = bounds.at[b].flight.stops[now];
    float stop_a = uintBitsToFloat(bits_a), stop_b = uintBitsToFloat(bits_b);
    if (stop_a > 1.0f && stop_b > 1.0f) return;
    if (push.pass > 0u) {
        atomicMin(bounds.at[a].flight.stops[next], bits_a);
        atomicMin(bounds.at[b].flight.stops[next], bits_b);
        if (!(stop_a < 1.0f || stop_b < 1.0f)) return;
    }
    Traits ta = traits.at[a], tb = traits.at[b];
    Course ca = course_of(ta, bounds.at[a].flight.position, bounds.at[a].flight.orientation, poses.at[a], stop_a);
    Course cb = course_of(tb, bounds.at[b].flight.position, bounds.at[b].flight.orientation, poses.at[b], stop_b);
    float fraction =
        impact_of(ta, ca, tb, cb, limits_of(ta, tb, hold_of(touching.at[i], stop_a, stop_b), PARAMETERS), false, Hulls(0u))
            .fraction;
    if (stop_a <= 1.0f) atomicMin(bounds.at[a].flight.stops[next], floatBitsToUint(fraction));
    if (stop_b <= 1.0f) atomicMin(bounds.at[b].flight.stops[next], floatBitsToUint(fraction));
}
