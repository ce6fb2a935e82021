// Poses and velocities of the parts of moving compounds, from their bodies.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/compound.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i < PARAMETERS.first_part || i >= PARAMETERS.bodies || COUNTED.overflow != 0u) return;
    BodyProperties body = READ(properties, i);
    if (motion_of(body) == MOTION_FIXED) return;
    PoseInBody part = part_in(i);
    Pose owner = poses.at[body.owner];
    WRITE(poses, i, pose_of_part(part, owner));
    WRITE(velocities, i, velocity_of_part(part, owner, velocities.at[body.owner]));
}
