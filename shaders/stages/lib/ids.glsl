// Ids, not rows, decide which body of a pair is A and the order of sums, so the host may reorder rows in memory
// (compute/tables/memory_order.h) without changing a bit.
#ifndef SCREE_STAGES_IDS_GLSL
#define SCREE_STAGES_IDS_GLSL

#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

uint id_of(uint row) {
    return REORDERED ? READ_WORD(ids, row) : row;
}

#endif
