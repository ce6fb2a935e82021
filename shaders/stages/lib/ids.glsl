// Ids, not rows, decide which of two bodies is the first of a pair and in which order sums are taken: so the host may put bodies
// into another order in memory (compute/step/memory_order.h) and changes no bit.
#ifndef SCREE_STAGES_IDS_GLSL
#define SCREE_STAGES_IDS_GLSL

#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

uint id_of(uint row) {
    return REORDERED ? READ_WORD(ids, row) : row;
}

#endif
