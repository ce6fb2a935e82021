// Adds what the user asks: impulses to velocities (once, also when the step is done again), forces to loads. It wakes the body.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/motion.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.actions || COUNTS.overflow != 0u) return;
    Action action = actions[i];
    if (is_absent(traits[action.body].motion)) return;
    Mass mass = mass_in_world(traits[action.body], poses[action.body].orientation, 1.0f);
    if (PARAMETERS.redo == 0u) velocities[action.body] = kicked(velocities[action.body], action, mass, PARAMETERS);
    rests[action.body] = 0u;
    loads[action.body] = loaded(loads[action.body], action, mass);
}
