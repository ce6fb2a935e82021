// Counts the kinds of pairs in each span of pairs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    uint spans = spans_of(COUNTED.pairs);
    if (i >= spans) return;
    uint found[KINDS];
    for (uint k = 0u; k < KINDS; ++k) found[k] = 0u;
    uint last = min((i + 1u) * SPAN, COUNTED.pairs);
    for (uint pair = i * SPAN; pair < last; ++pair) ++found[READ(pairs, pair).kind];
    for (uint k = 0u; k < KINDS; ++k) contact_starts.at[k * spans + i] = found[k];
}
