// Planes: four triangles around the point below the eye, with outer vertices at infinity (orthographic: far away).
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/scene.h"

layout(location = 0) flat out vec4 out_plane;  // unit normal; w: height of the eye above the plane, m
layout(location = 1) flat out vec4 out_u;      // tangent axis; w: the eye's coordinate on it, m
layout(location = 2) flat out vec4 out_v;

void main() {
    uint body = instances[gl_InstanceIndex];
    vec3 n = properties[body].size;
    float height = dot(n, frame.eye.xyz - poses[body].position);
    // Tangent axes aligned with the world's where possible: on the ground u is x and v is z.
    vec3 v = normalize(abs(n.z) < 0.9 ? vec3(0, 0, 1) - n * n.z : vec3(0, 1, 0) - n * n.y);
    vec3 u = cross(n, v);
    out_plane = vec4(n, height);
    out_u = vec4(u, dot(u, frame.eye.xyz));
    out_v = vec4(v, dot(v, frame.eye.xyz));
    int corner = gl_VertexIndex % 3;
    int quarter = gl_VertexIndex / 3 + (corner == 2 ? 1 : 0);
    float x = quarter == 0 || quarter == 3 || quarter == 4 ? 1.0 : -1.0;
    float y = quarter % 4 < 2 ? 1.0 : -1.0;
    vec3 along = u * x + v * y;
    vec4 at = orthographic() ? vec4(along * (4.0 / frame.pixel.w) - n * height, 1.0) : vec4(along, 0.0);
    if (corner == 0) at = vec4(-n * height, 1.0);
    // Planes are invisible from behind.
    bool seen = orthographic() ? dot(n, frame.forward.xyz) < -1e-4 : height > 0.0;
    gl_Position = seen ? frame.view_projection * at : vec4(0, 0, -1, 1);
}
