// Continuous collision: drops the doubtful speculative contacts of bodies that nothing strikes in this step, which will
// therefore follow their predicted sweep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/continuous/time_of_impact.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs || (WORD(point_counts, i) & SPECULATIVE) == 0u) return;
    uint flags = READ(bounds, body_of(READ(pairs, i).a)).sweep.marks | READ(bounds, body_of(READ(pairs, i).b)).sweep.marks;
    bool struck = (flags & STRUCK) != 0u;
    WORD(point_counts, i) = struck ? WORD(point_counts, i) & ~SPECULATIVE : 0u;
}
