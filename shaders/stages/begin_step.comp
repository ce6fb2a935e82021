// Empties the lists of a step, gives every body its gravity, and wakes all if the user says so.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/motion.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i < PARAMETERS.buckets + 2u) cells.at[i] = 0u;
    if (i <= PARAMETERS.bodies) {
        pair_starts.at[i] = 0u;
        slot_ends.at[i] = 0u;
    }
    if (i < PARAMETERS.bodies) {
        loads.at[i] = gravity_load(READ(traits, i), PARAMETERS);
        if (PARAMETERS.wake_all != 0u) rests.at[i] = 0u;
    }
    if (i == 0u) COUNTS = emptied(COUNTS, PARAMETERS);
}
