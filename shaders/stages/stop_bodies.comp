// Puts the fast bodies that must stop back to where they do.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/flight.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u || COUNTS.fast == 0u) return;
    float stop = stop_of(bounds.at[i].flight);
    if (stop >= 1.0f || traits.at[i].joints != NONE) return;
    Halted after = halted(bounds.at[i].flight, poses.at[i], velocities.at[i], loads.at[i], stop);
    poses.at[i] = after.pose;
    velocities.at[i] = after.velocity;
}
