// Puts the fast bodies that must stop back to where they do.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/flight.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u || COUNTS.fast == 0u) return;
    float stop = stop_of(bounds[i].flight);
    if (stop >= 1.0f || traits[i].joints != NONE) return;
    Halted after = halted(bounds[i].flight, poses[i], velocities[i], loads[i], stop);
    poses[i] = after.pose;
    velocities[i] = after.velocity;
}
