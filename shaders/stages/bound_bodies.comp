// Each body's bounds over the coming step, its cell, whether it stirs, its inertia in the world, where it starts, and whether it
// will be fast.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/motion.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

// Most bodies have nothing new to say, and an atomic that all ask for is slow.
#define note(mask, bits)                                     \
    {                                                        \
        if ((mask & (bits)) != (bits)) atomicOr(mask, bits); \
    }

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies) return;
    Traits body = traits[i];
    Pose pose = poses[i];
    if (is_absent(body.motion)) {
        bounds[i] = no_bounds(pose);
        return;
    }
    Bounds around = bounds_of(body, pose, velocities[i], loads[i], PARAMETERS);
    if (will_be_fast(body, velocities[i], PARAMETERS)) note(COUNTS.fast, 1u);
    masses[i] = mass_in_world(body, pose.orientation, masses[i].split);
    atomicAdd(cells[around.bucket], 1u);
    if (!is_large(body)) note(COUNTS.levels, 1u << around.level);
    if (has_slept(rests[i], PARAMETERS.sleep_steps)) note(COUNTS.sleepers, 1u);
    if (stirs(body.motion, velocities[i], rests[i], PARAMETERS.sleep_steps)) {
        if (!is_large(body)) note(COUNTS.levels_stirring, 1u << around.level);
        if (is_large(body)) note(COUNTS.large_stirring, 1u);
    } else {
        around.level |= STILL;
    }
    bounds[i] = around;
}
