// Puts the fast bodies that must stop back to where they do.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/extra/sweep.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || COUNTED.fast == 0u) return;
    float stop = stop_of(READ(bounds, i).flight);
    if (stop >= 1.0f || READ(traits, i).joints != NONE) return;
    Halted after = halted(READ(bounds, i).flight, poses.at[i], velocities.at[i], READ(loads, i), stop);
    poses.at[i] = after.pose;
    velocities.at[i] = after.velocity;
}
