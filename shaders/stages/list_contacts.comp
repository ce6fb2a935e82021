// Gives every touching pair its contact, and counts the contacts of each body that can be moved.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.pairs || touching[i] == 0u) return;
    Pair pair = pairs[i];
    constraints[contact_starts[i]].pair = i;
    if (traits[pair.a].motion == MOTION_DYNAMIC) atomicAdd(slot_ends[pair.a], 1u);
    if (traits[pair.b].motion == MOTION_DYNAMIC) atomicAdd(slot_ends[pair.b], 1u);
}
