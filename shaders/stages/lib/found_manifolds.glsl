// The manifolds that the narrowphase finds, one after the other in any order: most pairs have no points.
#ifndef SCREE_STAGES_FOUND_MANIFOLDS_GLSL
#define SCREE_STAGES_FOUND_MANIFOLDS_GLSL

#include "shaders/stages/lib/stage.glsl"

// More than there is room for are counted but not kept: the step is repeated with more room (work_counts.h).
void keep_manifold(uint pair, Manifold manifold, uint points) {
    WORD(point_counts, pair) = points;
    if (points == 0u) return;
    uint place = atomicAdd(COUNTS.contacts, 1u);
    WORD(manifold_places, pair) = min(place, PARAMETERS.contact_capacity - 1u);
    if (place < PARAMETERS.contact_capacity) WRITE(manifolds, place, manifold);
}

// Of a pair with points, in later stages.
#define FOUND_MANIFOLD(pair) READ(manifolds, READ_WORD(manifold_places, pair))

#endif
