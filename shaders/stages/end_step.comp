// Gathers the last relaxation; and notes who has been fast, and who has left the bounds that were searched for neighbours.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/flight.h"
#include "shaders/physics/motion.h"
#include "shaders/stages/stage.glsl"

// after the tables that it sums
#include "shaders/stages/gather.glsl"

void main() {
    uint i = thread();
    if (COUNTS.overflow != 0u) return;
    if (i == 0u) ++COUNTS.steps;
    if (i >= PARAMETERS.bodies) return;
    Traits body = traits[i];
    if (body.motion != MOTION_DYNAMIC) return;
    Velocity change = gather(i).change;
    velocities[i].linear = without_dust(velocities[i].linear + change.linear);
    velocities[i].angular = without_dust(velocities[i].angular + change.angular);
    Flight flight = flights[i];
    if (!was_fast(body, flight, poses[i])) return;
    flights[i] = stopped_at(flight, seen_part(body, flight, poses[i], bounds[i]));
    atomicOr(COUNTS.fast, 1u);
    atomicMax(COUNTS.arguments[WORK_FLIGHTS].x, COUNTS.arguments[WORK_PAIRS].x);
    atomicMax(COUNTS.arguments[WORK_FLIGHTS].w, COUNTS.arguments[WORK_PAIRS].w);
}
