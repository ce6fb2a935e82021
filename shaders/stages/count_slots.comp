// Counts the contacts of each body that can be moved.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts || !any_stirs(COUNTED)) return;
    Pair pair = READ(pairs, READ(constraints, i).pair);
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    uint sleep_steps = PARAMETERS.sleep_steps;
    if (is_movable(READ(traits, of_a).motion, READ(rests, of_a), sleep_steps)) atomicAdd(slot_ends.at[of_a], 1u);
    if (is_movable(READ(traits, of_b).motion, READ(rests, of_b), sleep_steps)) atomicAdd(slot_ends.at[of_b], 1u);
}
