// Cylinders, cones, hulls and meshes: triangles with vertex normals.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/solid_corner.h"

layout(location = 4) flat out vec4 out_color;  // w: position on the colour scale

void main() {
    Corner at = corner_of_body();
    if (place_corner(at)) out_color = tints[at.body];
}
