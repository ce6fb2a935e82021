// Bodies that have left the periodic cell through one side come in through the opposite one.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/periodic_cell.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    // A repeated step begins where the first attempt did.
    if (i >= PARAMETERS.first_part || PARAMETERS.redo != 0u || READ(properties, i).motion == MOTION_FIXED) return;
    Image inside = image_inside(READ(poses, i).position, PARAMETERS);
    WRITE(poses, i, at_image(READ(poses, i), inside));
    WRITE(velocities, i, at_image(READ(velocities, i), inside));
}
