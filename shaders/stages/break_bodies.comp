// Puts the pieces of bodies that break into their places.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/fracture.h"
#include "shaders/stages/hulls.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u || COUNTS.broken == 0u || !(loads[i].kept < 1.0f)) return;
    Fracturing fracturing = fracturing_of(Hulls(0u), traits[i].fracture);
    Pose pose = poses[i];
    Velocity velocity = velocities[i];
    uint pieces = pieces_of(Hulls(0u), fracturing);
    for (uint k = 0u; k < pieces; ++k) {
        uint row = fracturing.first_piece + k;
        Moved part = piece_of(Hulls(0u), fracturing, k, pose, velocity);
        poses[row] = part.pose;
        velocities[row] = part.velocity;
        rests[row] = 0u;
        traits[row].motion = MOTION_DYNAMIC;
        if (traits[row].fracture == NONE) continue;
        traits[row].strain = strain_after(fracturing_of(Hulls(0u), traits[row].fracture), 0.0f, traits[row], part.velocity);
    }
    traits[i].motion = MOTION_BROKEN;
    traits[i].strain = 0u;
    rests[i] = 0u;
    velocities[i] = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
}
