// Adds what the user asks: impulses to velocities (once, also when the step is done again), forces to loads. It wakes the body.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/solve/motion.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.actions || COUNTED.overflow != 0u) return;
    Action action = actions.at[i];
    if (is_absent(READ(traits, action.body).motion)) return;
    Mass mass = mass_in_world(READ(traits, action.body), READ(poses, action.body).orientation, 1.0f);
    if (PARAMETERS.redo == 0u) velocities.at[action.body] = kicked(velocities.at[action.body], action, mass, PARAMETERS);
    WORD(rests, action.body) = 0u;
    loads.at[action.body] = loaded(loads.at[action.body], action, mass);
}
