// Fills the list of visible bodies, sorted by level of detail.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/detail/detail.h"

shared uint found[DETAIL_GROUP];

void main() {
    uint group = gl_WorkGroupID.x, place = gl_GlobalInvocationID.x, own = gl_LocalInvocationID.x;
    uint run = run_of_place(place);
    found[own] = run;
    barrier();
    if (run == NOT_SEEN) return;
    // Stable within a run, so that bodies are drawn in the same order on every device.
    uint before = 0u;
    for (uint k = 0u; k < own; ++k) before += found[k] == run ? 1u : 0u;
    instances[runs[run].first + group_counts[group * GROUP_WORDS + run] + before] = instances[place];
}
