// Lists the pairs kind by kind, in their order, and says how many of each there are.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    uint spans = spans_of(COUNTED.pairs);
    if (i >= spans) return;
    uint next[KINDS];
    for (uint k = 0u; k < KINDS; ++k) next[k] = READ(contact_starts, k * spans + i);
    uint last = min((i + 1u) * SPAN, COUNTED.pairs);
    for (uint pair = i * SPAN; pair < last; ++pair) binned.at[next[READ(pairs, pair).kind]++] = pair;
    if (i > 0u) return;
    Counts mine = COUNTS;
    for (uint k = 0u; k < KINDS; ++k)
        mine = with_kinds(mine, k, READ(contact_starts, k * spans), READ(contact_starts, (k + 1u) * spans), PARAMETERS);
    // Only what no other thread reads.
    COUNTS.kind_first = mine.kind_first;
    COUNTS.arguments = mine.arguments;
}
