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
    Traits body = traits.at[i];
    Pose pose = poses.at[i];
    Bounds around = bounds_of(body, pose, velocities.at[i], loads.at[i], PARAMETERS);
    if (will_be_fast(body, velocities.at[i], PARAMETERS)) note(COUNTS.fast, 1u);
    masses.at[i] = mass_in_world(body, pose.orientation, masses.at[i].split);
    atomicAdd(cells.at[around.bucket], 1u);
    if (!is_large(body)) note(COUNTS.levels, 1u << around.level);
    if (has_slept(rests.at[i], PARAMETERS.sleep_steps)) note(COUNTS.sleepers, 1u);
    if (stirs(body.motion, velocities.at[i], rests.at[i], PARAMETERS.sleep_steps)) {
        if (!is_large(body)) note(COUNTS.levels_stirring, 1u << around.level);
        if (is_large(body)) note(COUNTS.large_stirring, 1u);
    } else {
        around.level |= STILL;
    }
    bounds.at[i] = around;
}
