// Labels of planes: a triangle that covers the picture.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/scene.h"

layout(location = 0) flat out vec4 out_plane;  // unit normal; w: height of the eye above the plane, m
layout(location = 1) flat out uint out_row;

void main() {
    uint body = instances[gl_InstanceIndex];
    vec3 n = properties[body].size;
    out_plane = vec4(n, dot(n, frame.eye.xyz - poses[body].position));
    out_row = body;
    int corner = gl_VertexIndex % 3;
    gl_Position = vec4(corner == 1 ? 3.0 : -1.0, corner == 2 ? 3.0 : -1.0, 0.5, 1.0);
    if (is_absent(properties[body].motion)) gl_Position = vec4(0, 0, -1, 1);
}
