// Labels of hulls and meshes: where the ray of the pixel meets the triangle's plane.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/labels/label.h"

layout(location = 0) flat in uint row;
layout(location = 1) in vec3 point;
layout(location = 2) flat in vec3 corner;
layout(location = 3) flat in vec3 normal;

void main() {
    float straight = dot(point, frame.forward.xyz);
    vec3 start = ray_start(gl_FragCoord.xy), along = ray_direction(gl_FragCoord.xy);
    float depth = dot(normal, corner - start) / dot(normal, along);
    // Slivers and grazing rays have no plane worth the name.
    if (!(abs(depth - straight) < 0.001 * abs(straight))) depth = straight;
    tell(row, normal, depth);
}
