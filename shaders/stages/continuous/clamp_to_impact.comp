// Continuous collision: clamps fast bodies to their time of impact.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/motion.h"
#include "shaders/physics/continuous/clamping.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || COUNTED.fast == 0u) return;
    float stop = stop_of(READ(bounds, i).sweep);
    if (stop >= 1.0f) return;
    ClampedMotion after =
        clamp_motion(READ(bounds, i).sweep, poses.at[i], velocities.at[i], READ(properties, i), READ(forces, i), stop);
    WRITE(poses, i, after.pose);
    WRITE(velocities, i, held_velocity(after.velocity, PARAMETERS));
}
