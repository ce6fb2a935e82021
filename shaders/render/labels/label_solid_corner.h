// Vertex stage of labels of hulls and meshes: their triangles.
#ifndef SCREE_RENDER_LABEL_SOLID_CORNER_H
#define SCREE_RENDER_LABEL_SOLID_CORNER_H

#include "shaders/render/bodies/solid_mesh.h"
#include "shaders/render/labels/label_rows.h"

layout(location = 0) flat out uint out_row;
#ifndef LISTS_COVERS
layout(location = 1) out vec3 out_point;        // relative to the eye
layout(location = 2) flat out vec3 out_corner;  // a corner of the triangle, likewise
layout(location = 3) flat out vec3 out_normal;  // of the triangle, in the world
#endif

// What is seen is covered: labels and lists of covers must have equal positions.
invariant gl_Position;

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
    vec3 point = pose.position - frame.eye.xyz + turned(pose.orientation, corner.point);
    gl_Position = frame.view_projection * vec4(point, 1.0);
    // A patch of a mesh is drawn with the row of its first triangle.
    out_row = at.body + (t.shape == SHAPE_TRIANGLE ? (at.corner - first) / 3u : 0u);
#ifndef LISTS_COVERS
    out_point = out_corner = point;
    out_normal = turned(pose.orientation, corner.normal);
#endif
}

#endif
