// Gives each contact a slot with each of its bodies, in any order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts) return;
    Pair pair = pairs[constraints[i].pair];
    constraints[i].slot_a = NONE;
    constraints[i].slot_b = NONE;
    if (traits[pair.a].motion == MOTION_DYNAMIC) slot_sides[atomicAdd(slot_ends[pair.a], 1u)] = 2u * i;
    if (traits[pair.b].motion == MOTION_DYNAMIC) slot_sides[atomicAdd(slot_ends[pair.b], 1u)] = 2u * i + 1u;
}
