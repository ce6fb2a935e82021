// Counts the contacts of each body that can be moved.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts || !any_stirs(COUNTS)) return;
    Pair pair = pairs.at[constraints.at[i].pair];
    uint sleep_steps = PARAMETERS.sleep_steps;
    if (is_movable(traits.at[pair.a].motion, rests.at[pair.a], sleep_steps)) atomicAdd(slot_ends.at[pair.a], 1u);
    if (is_movable(traits.at[pair.b].motion, rests.at[pair.b], sleep_steps)) atomicAdd(slot_ends.at[pair.b], 1u);
}
