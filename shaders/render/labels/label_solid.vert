// Labels of hulls and meshes: their triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/solid_mesh.h"
#include "shaders/render/labels/label_rows.h"

layout(location = 0) out vec3 out_point;        // relative to the eye
layout(location = 1) flat out vec3 out_corner;  // a corner of the triangle, likewise
layout(location = 2) flat out vec3 out_normal;  // of the triangle, in the world
layout(location = 3) flat out uint out_row;

void main() {
    Corner at = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    if (!at.there) return;
    BodyProperties t = properties[at.body];
    uint first = runs[pushed >> 8].directions;
    bool round = directions[first + at.body].z > 0.5;  // label_round.vert
    if (round || !is_told(t)) return;
    MeshCorner corner = mesh_corner(at, t.size);
    if (!corner.there) return;
    Pose pose = poses[at.body];
    out_point = out_corner = pose.position - frame.eye.xyz + turned(pose.orientation, corner.point);
    out_normal = turned(pose.orientation, corner.normal);
    // A patch of a mesh is drawn with the row of its first triangle.
    out_row = at.body + (t.shape == SHAPE_TRIANGLE ? (at.corner - first) / 3u : 0u);
    gl_Position = frame.view_projection * vec4(out_point, 1.0);
}
