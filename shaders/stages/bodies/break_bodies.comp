// Fracture: activates the fragments of bodies that break, with their poses and velocities.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/fracture/fracture.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || COUNTED.broken == 0u || !(READ(forces, i).kept < 1.0f)) return;
    Fracturing fracturing = READ_QUADS(fractures, properties.at[i].fracture);
    Pose pose = poses.at[i];
    Velocity velocity = velocities.at[i];
    for (uint k = 0u; k < fracturing.count; ++k) {
        uint row = fracturing.first_row + k;
        RigidState part = piece_of(READ_QUADS(pieces, fracturing.first_pose + k), pose, velocity);
        WRITE(poses, row, part.pose);
        WRITE(velocities, row, part.velocity);
        WORD(sleep_states, row) = 0u;
        properties.at[row].motion = MOTION_DYNAMIC;
        if (properties.at[row].fracture == NONE) continue;
        SET_FLOAT(strains, row,
                  strain_after(READ_QUADS(fractures, properties.at[row].fracture), 0.0f, properties.at[row], part.velocity));
    }
    properties.at[i].motion = MOTION_BROKEN;
    SET_FLOAT(strains, i, 0.0f);
    WORD(sleep_states, i) = 0u;
    WRITE(velocities, i, Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f));
}
