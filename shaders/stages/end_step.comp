// Gathers the last relaxation; the step is done.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/motion.h"
#include "shaders/stages/stage.glsl"

// after the tables that it sums
#include "shaders/stages/gather.glsl"

void main() {
    uint i = thread();
    if (COUNTS.overflow != 0u) return;
    if (i == 0u) ++COUNTS.steps;
    if (i >= PARAMETERS.bodies || traits[i].motion != MOTION_DYNAMIC) return;
    Velocity change = gather(i).change;
    velocities[i].linear = without_dust(velocities[i].linear + change.linear);
    velocities[i].angular = without_dust(velocities[i].angular + change.angular);
}
