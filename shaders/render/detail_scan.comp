// Prefix sums of the workgroups' counts; one thread per run.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/detail.h"

shared uint totals[SEEN_RUNS];

void main() {
    uint run = gl_LocalInvocationID.x;
    uint sum = 0u;
    if (run < SEEN_RUNS) {
        uint groups = (bodies_to_see() + DETAIL_GROUP - 1u) / DETAIL_GROUP;
        for (uint group = 0u; group < groups; ++group) {
            uint at = group * SEEN_RUNS + run;
            uint count = group_counts[at];
            group_counts[at] = sum;
            sum += count;
        }
        totals[run] = sum;
    }
    barrier();
    if (run >= SEEN_RUNS) return;
    uint first = runs[RUN_PLANES].first + runs[RUN_PLANES].count;
    for (uint k = 0u; k < run; ++k) first += totals[k];
    runs[run].first = first;
    runs[run].count = sum;
    arguments[run].instances = (sum + runs[run].together - 1u) / runs[run].together;
}
