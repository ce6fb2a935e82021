// Counts visible bodies by level of detail in each workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/detail.h"

shared uint counts[SEEN_RUNS];

void main() {
    uint group = gl_WorkGroupID.x, place = gl_GlobalInvocationID.x, own = gl_LocalInvocationID.x;
    if (own < SEEN_RUNS) counts[own] = 0u;
    barrier();
    uint run = run_of_place(place);
    if (run != NOT_SEEN) atomicAdd(counts[run], 1u);
    barrier();
    if (own < SEEN_RUNS) group_counts[group * SEEN_RUNS + own] = counts[own];
}
