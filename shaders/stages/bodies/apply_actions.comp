// Applies user actions and wakes their bodies: impulses to velocities (once, also if the step is repeated), forces to
// accelerations.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/driven.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.actions || COUNTED.overflow != 0u) return;
    Action action = actions.at[i];
    if (is_out_of_play(READ(properties, action.body).motion)) return;
    BodyProperties body = READ(properties, action.body);
    Mass mass = mass_in_world(body, READ(poses, action.body).orientation);
    bool sets = (action.flags & ACTION_SETS_VELOCITY) != 0u && body.motion == MOTION_DYNAMIC;
    if (PARAMETERS.redo == 0u) {
        Velocity velocity = apply_impulses(velocities.at[action.body], action, mass, PARAMETERS);
        if (changes_velocity(action, body)) velocity = velocity_before_substeps(velocity, action, PARAMETERS);
        WRITE(velocities, action.body, velocity);
    }
    WORD(sleep_states, action.body) = sets ? RESTARTS : roused(WORD(sleep_states, action.body), PARAMETERS.sleep_steps);
    WRITE(forces, action.body, apply_forces(forces.at[action.body], action, mass));
}
