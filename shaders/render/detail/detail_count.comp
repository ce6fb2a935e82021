// Counts visible bodies by level of detail in each workgroup, and bounds what casts shadows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light_bounds.h"

shared uint counts[SEEN_RUNS];
shared float bounds[LIGHT_BOUNDS * DETAIL_GROUP];

void note(uint first, vec3 values, uint own) {
    for (uint k = 0u; k < 3u; ++k) bounds[(first + k) * DETAIL_GROUP + own] = values[k];
}

void main() {
    uint group = gl_WorkGroupID.x, place = gl_GlobalInvocationID.x, own = gl_LocalInvocationID.x;
    if (own < SEEN_RUNS) counts[own] = 0u;
    barrier();
    uint run = run_of_place(place);
    if (run != NOT_SEEN) atomicAdd(counts[run], 1u);
    LightBounds lit = bounds_of_place(place);
    note(0u, lit.sun_low, own);
    note(3u, lit.sky_low, own);
    note(6u, -lit.sun_high, own);
    note(9u, -lit.sky_high, own);
    barrier();
    if (own < SEEN_RUNS) group_counts[group * GROUP_WORDS + own] = counts[own];
    if (own >= LIGHT_BOUNDS) return;
    float least = NOWHERE;
    for (uint i = 0u; i < DETAIL_GROUP; ++i) least = min(least, bounds[own * DETAIL_GROUP + i]);
    group_counts[group * GROUP_WORDS + SEEN_RUNS + own] = floatBitsToUint(least);
}
