// Counts the contacts of each body that can be moved.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts || !any_stirs(COUNTS)) return;
    Pair pair = pairs[constraints[i].pair];
    uint sleep_steps = PARAMETERS.sleep_steps;
    if (is_movable(traits[pair.a].motion, rests[pair.a], sleep_steps)) atomicAdd(slot_ends[pair.a], 1u);
    if (is_movable(traits[pair.b].motion, rests[pair.b], sleep_steps)) atomicAdd(slot_ends[pair.b], 1u);
}
