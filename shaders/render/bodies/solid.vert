// Cylinders, cones, hulls and meshes: triangles with vertex normals.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/solid_mesh.h"

layout(location = 0) out vec3 out_point;   // relative to the eye
layout(location = 1) out vec3 out_normal;  // in the body's frame
layout(location = 2) out vec3 out_own;     // in the body's frame, in half sizes
layout(location = 3) flat out vec4 out_turn;
layout(location = 4) flat out vec4 out_color;  // w: position on the colour scale
layout(location = 5) out vec2 out_edge;        // distance to the edge of a hull's face, width of its edges; 0: none, m

// The depth prepass and the shading pass must give equal positions.
invariant gl_Position;

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
    out_color = tints[at.body];
    gl_Position = frame.view_projection * vec4(out_point, 1.0);
}
