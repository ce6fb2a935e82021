// Gathers the biased pass and moves the bodies by a substep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/motion.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

// after the tables that it sums
#include "shaders/stages/gather.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u || is_asleep(rests[i], PARAMETERS.sleep_steps)) return;
    Traits body = traits[i];
    if (body.motion == MOTION_FIXED || is_absent(body.motion)) return;
    Velocity velocity = velocities[i];
    if (body.motion == MOTION_DYNAMIC) {
        Gathered sum = gather(i);
        velocity.linear = velocity.linear + sum.change.linear;
        velocity.angular = velocity.angular + sum.change.angular;
        loads[i].blows = sum.carrying;
    }
    Moved after = moved(poses[i], velocity, body, PARAMETERS.h);
    poses[i] = after.pose;
    velocities[i] = after.velocity;
    if (!turns_evenly(body)) masses[i] = mass_in_world(body, after.pose.orientation, masses[i].split);
}
