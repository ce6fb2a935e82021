// Gathers the last relaxation, says who has come to rest, and notes who has been fast and left the bounds that were searched for
// its neighbours; the step is done.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/extra/sweep.h"
#include "shaders/physics/solve/motion.h"
#include "shaders/stages/lib/stage.glsl"

// after the tables that it sums
#include "shaders/stages/lib/gather.glsl"

void main() {
    uint i = thread();
    if (COUNTED.overflow != 0u) return;
    if (i == 0u) ++COUNTS.steps;
    if (i >= PARAMETERS.bodies || is_asleep(WORD(rests, i), PARAMETERS.sleep_steps)) return;
    Traits body = READ(traits, i);
    if (body.motion != MOTION_DYNAMIC) return;
    Gathered sum = gather(i);
    Velocity velocity = READ(velocities, i);
    velocity.linear = without_dust(velocity.linear + sum.change.linear);
    velocity.angular = without_dust(velocity.angular + sum.change.angular);
    float pace = pace_of(body, velocity, PARAMETERS);
    WORD(rests, i) = rest_after(WORD(rests, i), pace, sum.carrying, sum.told, PARAMETERS.sleep_steps);
    if (is_asleep(WORD(rests, i), PARAMETERS.sleep_steps)) {
        velocity.linear = vec3(0.0f);
        velocity.angular = vec3(0.0f);
    }
    velocities.at[i] = velocity;
    Flight flight = bounds.at[i].flight;
    if (!was_fast(body, flight, READ(poses, i))) return;
    bounds.at[i].flight = stopped_at(flight, seen_part(body, flight, READ(poses, i), bounds.at[i]));
    atomicOr(COUNTS.fast, 1u);
    atomicMax(COUNTS.arguments[WORK_FLIGHTS].x, COUNTS.arguments[WORK_PAIRS].x);
    atomicMax(COUNTS.arguments[WORK_FLIGHTS].w, COUNTS.arguments[WORK_PAIRS].w);
}
