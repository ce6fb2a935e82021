// Gathers the last relaxation, and says who has come to rest; the step is done.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/motion.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

// after the tables that it sums
#include "shaders/stages/gather.glsl"

void main() {
    uint i = thread();
    if (COUNTS.overflow != 0u) return;
    if (i == 0u) ++COUNTS.steps;
    if (i >= PARAMETERS.bodies || is_asleep(rests[i], PARAMETERS.sleep_steps)) return;
    Traits body = traits[i];
    if (body.motion != MOTION_DYNAMIC) return;
    Gathered sum = gather(i);
    Velocity velocity = velocities[i];
    velocity.linear = without_dust(velocity.linear + sum.change.linear);
    velocity.angular = without_dust(velocity.angular + sum.change.angular);
    float pace = pace_of(body, velocity, PARAMETERS);
    rests[i] = rest_after(rests[i], pace, sum.carrying, sum.told, PARAMETERS.sleep_steps);
    if (is_asleep(rests[i], PARAMETERS.sleep_steps)) {
        velocity.linear = vec3(0.0f);
        velocity.angular = vec3(0.0f);
    }
    velocities[i] = velocity;
}
