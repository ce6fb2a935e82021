// Puts the parts of bodies that move where their bodies are, and gives them their velocities.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/collide/compound.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i < PARAMETERS.first_part || i >= PARAMETERS.bodies || COUNTED.overflow != 0u) return;
    Traits part = READ(traits, i);
    if (motion_of(part) == MOTION_FIXED) return;
    Pose owner = poses.at[part.owner];
    poses.at[i] = pose_of_part(place_in_body(part), turn_in_body(part), owner);
    velocities.at[i] = velocity_of_part(part, owner, velocities.at[part.owner]);
}
