// Puts the pieces of bodies that break into their places.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/extra/fracture.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || COUNTED.broken == 0u || !(READ(loads, i).kept < 1.0f)) return;
    Fracturing fracturing = READ_QUADS(fractures, traits.at[i].fracture);
    Pose pose = poses.at[i];
    Velocity velocity = velocities.at[i];
    for (uint k = 0u; k < fracturing.count; ++k) {
        uint row = fracturing.first_row + k;
        Moved part = piece_of(READ_QUADS(pieces, fracturing.first_pose + k), pose, velocity);
        poses.at[row] = part.pose;
        velocities.at[row] = part.velocity;
        WORD(rests, row) = 0u;
        traits.at[row].motion = MOTION_DYNAMIC;
        if (traits.at[row].fracture == NONE) continue;
        SET_FLOAT(strains, row,
                  strain_after(READ_QUADS(fractures, traits.at[row].fracture), 0.0f, traits.at[row], part.velocity));
    }
    traits.at[i].motion = MOTION_BROKEN;
    SET_FLOAT(strains, i, 0.0f);
    WORD(rests, i) = 0u;
    velocities.at[i] = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
}
