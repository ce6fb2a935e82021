// Puts the pieces of bodies that break into their places.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/extra/fracture.h"
#include "shaders/stages/lib/shape_data.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || COUNTED.broken == 0u || !(READ(loads, i).kept < 1.0f)) return;
    Fracturing fracturing = fracturing_of(Hulls(0u), traits.at[i].fracture);
    Pose pose = poses.at[i];
    Velocity velocity = velocities.at[i];
    uint pieces = pieces_of(Hulls(0u), fracturing);
    for (uint k = 0u; k < pieces; ++k) {
        uint row = fracturing.first_piece + k;
        Moved part = piece_of(Hulls(0u), fracturing, k, pose, velocity);
        poses.at[row] = part.pose;
        velocities.at[row] = part.velocity;
        rests.at[row] = 0u;
        traits.at[row].motion = MOTION_DYNAMIC;
        if (traits.at[row].fracture == NONE) continue;
        traits.at[row].strain =
            strain_after(fracturing_of(Hulls(0u), traits.at[row].fracture), 0.0f, traits.at[row], part.velocity);
    }
    traits.at[i].motion = MOTION_BROKEN;
    traits.at[i].strain = 0u;
    rests.at[i] = 0u;
    velocities.at[i] = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
}
