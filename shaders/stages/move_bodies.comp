// Gathers the biased pass and moves the bodies by a substep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/motion.h"
#include "shaders/physics/parts.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

// after the tables that it sums
#include "shaders/stages/gather.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || is_asleep(READ(rests, i), PARAMETERS.sleep_steps)) return;
    Traits body = READ(traits, i);
    if (body.motion == MOTION_FIXED || is_part(body) || is_absent(body.motion)) return;
    Velocity velocity = READ(velocities, i);
    if (body.motion == MOTION_DYNAMIC) {
        Gathered sum = gather(i);
        velocity.linear = velocity.linear + sum.change.linear;
        velocity.angular = velocity.angular + sum.change.angular;
        loads.at[i].blows = sum.carrying;
    }
    Moved after = moved(READ(poses, i), velocity, body, PARAMETERS.h);
    poses.at[i] = after.pose;
    velocities.at[i] = after.velocity;
    if (!turns_evenly(body)) masses.at[i] = mass_in_world(body, after.pose.orientation, READ(masses, i).split);
}
