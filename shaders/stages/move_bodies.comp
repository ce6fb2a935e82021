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
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u || is_asleep(rests.at[i], PARAMETERS.sleep_steps)) return;
    Traits body = traits.at[i];
    if (body.motion == MOTION_FIXED) return;
    Velocity velocity = velocities.at[i];
    if (body.motion == MOTION_DYNAMIC) {
        Gathered sum = gather(i);
        velocity.linear = velocity.linear + sum.change.linear;
        velocity.angular = velocity.angular + sum.change.angular;
        loads.at[i].blows = sum.carrying;
    }
    Moved after = moved(poses.at[i], velocity, body, PARAMETERS.h);
    poses.at[i] = after.pose;
    velocities.at[i] = after.velocity;
    if (!turns_evenly(body)) masses.at[i] = mass_in_world(body, after.pose.orientation, masses.at[i].split);
}
