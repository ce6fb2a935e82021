// Radix sort of keyed rows, four bits at a time: each thread counts the digits of a run of rows (step 2 k), and after a scan
// of the counts moves them (step 2 k + 1).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/queries/tables.glsl"

void main() {
    uint run = gl_GlobalInvocationID.x;
    if (run >= runs()) return;
    uint digit = push.step >> 1u, first = run * RUN, last = min(first + RUN, push.items);
    bool back = (digit & 1u) != 0u;
    uint counts[DIGIT_VALUES];
    for (uint value = 0u; value < DIGIT_VALUES; ++value)
        counts[value] = (push.step & 1u) == 0u ? 0u : digits.at[HEAD + value * runs() + run];
    for (uint i = first; i < last; ++i) {
        KeyedRow row = back ? sorted_next.at[i] : sorted.at[i];
        uint value = (row.key >> (4u * digit)) & (DIGIT_VALUES - 1u);
        uint place = counts[value];
        counts[value] = place + 1u;
        if ((push.step & 1u) == 0u) continue;
        if (back)
            sorted.at[place] = row;
        else
            sorted_next.at[place] = row;
    }
    if ((push.step & 1u) != 0u) return;
    for (uint value = 0u; value < DIGIT_VALUES; ++value) digits.at[HEAD + value * runs() + run] = counts[value];
}
