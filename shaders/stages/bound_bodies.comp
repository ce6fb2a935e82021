// Each body's bounds over the coming step, its cell, its inertia in the world, where it starts, and whether it will be fast.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/motion.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies) return;
    Traits body = traits[i];
    Pose pose = poses[i];
    Bounds around = bounds_of(body, pose, velocities[i], loads[i], PARAMETERS);
    bounds[i] = around;
    flights[i] = flight_of(pose);
    if (will_be_fast(body, velocities[i], PARAMETERS)) atomicOr(COUNTS.fast, 1u);
    masses[i] = mass_in_world(body, pose.orientation, 1.0f);
    atomicAdd(cells[around.bucket], 1u);
    if (body.large == 0u) atomicOr(COUNTS.levels, 1u << around.level);
}
