// Meshes with surfaces of their own, and the other solids beside them: triangles with vertex normals.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/solid_corner.h"

layout(location = 4) out vec3 out_color;          // linear
layout(location = 6) out vec2 out_at;             // texture coordinates
layout(location = 7) flat out float out_texture;  // its number; below 0: none, below -1: nor a surface

// Of 0xBBGGRR in sRGB, linear.
vec3 unpacked(float levels) {
    uint bits = uint(levels);  // whole, below 2^24
    vec3 c = vec3(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u) / 255.0;
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, vec3(lessThan(c, vec3(0.04045))));
}

void main() {
    Corner at = corner_of_body();
    if (!place_corner(at)) return;
    out_color = tints[at.body].rgb;
    out_at = vec2(0.0);
    out_texture = -2.0;
    uint first = runs[pushed >> 8].directions;
    vec4 mesh = directions[first + at.body];
    if (mesh.w < 0.5) return;
    vec4 surface = directions[first + uint(mesh.x) + 2u * uint(mesh.y) + (at.corner - first)];
    if (surface.z < -1.5) return;
    out_at = surface.xy;
    out_texture = surface.z;
    out_color = unpacked(surface.w);
}
