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
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    uint sleep_steps = PARAMETERS.sleep_steps;
    if (is_movable(traits.at[of_a].motion, rests.at[of_a], sleep_steps)) atomicAdd(slot_ends.at[of_a], 1u);
    if (is_movable(traits.at[of_b].motion, rests.at[of_b], sleep_steps)) atomicAdd(slot_ends.at[of_b], 1u);
}
