// The pairs of one span by their kinds: counted, and, when the counts are summed, listed.
#ifndef SCREE_STAGES_KINDS_GLSL
#define SCREE_STAGES_KINDS_GLSL

#include "shaders/stages/lib/stage.glsl"

void count_kinds_of(uint span) {
    uint spans = spans_of(COUNTED.pairs);
    if (span >= spans) return;
    uint found[KINDS];
    for (uint k = 0u; k < KINDS; ++k) found[k] = 0u;
    uint last = min((span + 1u) * SPAN, COUNTED.pairs);
    for (uint pair = span * SPAN; pair < last; ++pair) ++found[READ(pairs, pair).kind];
    for (uint k = 0u; k < KINDS; ++k) WORD(kind_counts, k * spans + span) = found[k];
}

// In their order.
void list_kinds_of(uint span) {
    uint spans = spans_of(COUNTED.pairs);
    if (span >= spans) return;
    uint next[KINDS];
    for (uint k = 0u; k < KINDS; ++k) next[k] = READ_WORD(kind_starts, k * spans + span);
    uint last = min((span + 1u) * SPAN, COUNTED.pairs);
    for (uint pair = span * SPAN; pair < last; ++pair) WORD(pairs_by_kind, next[READ(pairs, pair).kind]++) = pair;
}

// Says how many pairs of a kind there are.
void tell_kind(uint kind) {
    uint spans = spans_of(COUNTED.pairs);
    if (kind >= KINDS || spans == 0u) return;
    uint first = READ_WORD(kind_starts, kind * spans), last = READ_WORD(kind_starts, (kind + 1u) * spans);
    COUNTS.kind_first[kind + 1u] = last;
    COUNTS.arguments[WORK_KIND + kind] = work_for(last - first, PARAMETERS);
}

#endif
