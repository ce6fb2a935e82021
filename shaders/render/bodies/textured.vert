// Meshes with surfaces of their own, and the other solids beside them: triangles with vertex normals.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/solid_mesh.h"

layout(location = 0) out vec3 out_point;   // relative to the eye
layout(location = 1) out vec3 out_normal;  // in the body's frame
layout(location = 2) out vec3 out_own;     // in the body's frame, in half sizes
layout(location = 3) flat out vec4 out_turn;
layout(location = 4) out vec3 out_color;          // linear
layout(location = 5) out vec2 out_edge;           // distance to the edge of a hull's face, width of its edges; 0: none, m
layout(location = 6) out vec2 out_at;             // texture coordinates
layout(location = 7) flat out float out_texture;  // its number; below 0: none, below -1: nor a surface

// The depth prepass and the shading pass must give equal positions.
invariant gl_Position;

// Of 0xBBGGRR in sRGB, linear.
vec3 unpacked(float levels) {
    uint bits = uint(levels);  // whole, below 2^24
    vec3 c = vec3(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u) / 255.0;
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, vec3(lessThan(c, vec3(0.04045))));
}

void main() {
    Corner at = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    if (!at.there) return;
    BodyProperties t = properties[at.body];
    MeshCorner corner = mesh_corner(at, t.size);
    if (!corner.there) return;
    Pose pose = poses[at.body];
    out_point = pose.position - frame.eye.xyz + turned(pose.orientation, corner.point);
    out_normal = corner.normal;
    out_edge = corner.edge;
    out_own = t.shape == SHAPE_HULL || t.shape == SHAPE_TRIANGLE ? vec3(0.0) : corner.point / t.size.x;
    out_turn = pose.orientation;
    gl_Position = frame.view_projection * vec4(out_point, 1.0);
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
