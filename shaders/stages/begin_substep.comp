// Gathers warm starts (and the last substep's relaxation), adds forces, pulls what the user holds, and splits each body among the
// contacts that carry.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/physics/grip.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

// after the tables that it sums
#include "shaders/stages/gather.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || is_asleep(READ(rests, i), PARAMETERS.sleep_steps)) return;
    Traits body = READ(traits, i);
    if (body.motion != MOTION_DYNAMIC) return;
    Gathered sum = gather(i);
    Velocity velocity = accelerated(READ(velocities, i), sum.change, READ(loads, i), body, PARAMETERS);
    for (uint k = 0u; k < PARAMETERS.held; ++k) {
        if (PARAMETERS.grips[k].body == i)
            velocity = pulled(velocity, READ(poses, i), READ(masses, i), PARAMETERS.grips[k], PARAMETERS);
    }
    velocities.at[i] = velocity;
    float crowd = READ(masses, i).split;
    if (push.pass != 0u) crowd = drifted(crowd, sum.carrying, COUNTED.steps);
    masses.at[i].split = crowd_after(crowd, sum.carrying, sum.pressing);
}
