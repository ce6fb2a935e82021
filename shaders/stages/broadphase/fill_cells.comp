// Broadphase: puts each body into its bucket, in any order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || READ(bounds, i).bucket == NONE) return;
    uint entry = atomicAdd(WORD(cell_starts, READ(bounds, i).bucket), 1u);
    cell_entries.at[entry].body = i;
}
