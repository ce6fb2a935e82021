// The pairs of one block of 16 binned by pair type: counted, then listed at the scanned offsets.
#ifndef SCREE_STAGES_PAIR_TYPES_GLSL
#define SCREE_STAGES_PAIR_TYPES_GLSL

#include "shaders/stages/lib/stage.glsl"

void count_kinds_of(uint pair_block) {
    uint pair_blocks = pair_blocks_of(COUNTED.pairs);
    if (pair_block >= pair_blocks) return;
    uint found[PAIR_TYPES];
    for (uint k = 0u; k < PAIR_TYPES; ++k) found[k] = 0u;
    uint last = min((pair_block + 1u) * PAIR_BLOCK, COUNTED.pairs);
    for (uint pair = pair_block * PAIR_BLOCK; pair < last; ++pair) ++found[READ(pairs, pair).pair_type];
    for (uint k = 0u; k < PAIR_TYPES; ++k) WORD(pair_type_counts, k * pair_blocks + pair_block) = found[k];
}

// Stably.
void list_kinds_of(uint pair_block) {
    uint pair_blocks = pair_blocks_of(COUNTED.pairs);
    if (pair_block >= pair_blocks) return;
    uint next[PAIR_TYPES];
    for (uint k = 0u; k < PAIR_TYPES; ++k) next[k] = READ_WORD(pair_type_starts, k * pair_blocks + pair_block);
    uint last = min((pair_block + 1u) * PAIR_BLOCK, COUNTED.pairs);
    for (uint pair = pair_block * PAIR_BLOCK; pair < last; ++pair)
        WORD(pairs_by_type, next[READ(pairs, pair).pair_type]++) = pair;
}

// Writes the range and dispatch of a pair type.
void tell_kind(uint pair_type) {
    uint pair_blocks = pair_blocks_of(COUNTED.pairs);
    if (pair_type >= PAIR_TYPES || pair_blocks == 0u) return;
    uint first = READ_WORD(pair_type_starts, pair_type * pair_blocks),
         last = READ_WORD(pair_type_starts, (pair_type + 1u) * pair_blocks);
    COUNTS.pair_type_first[pair_type + 1u] = last;
    COUNTS.arguments[WORK_PAIR_TYPE + pair_type] = work_for(last - first, PARAMETERS);
}

#endif
