// Vertex stage of labels of boxes: the faces towards the eye.
#ifndef SCREE_RENDER_LABEL_BOX_CORNER_H
#define SCREE_RENDER_LABEL_BOX_CORNER_H

#include "shaders/render/bodies/batch.h"
#include "shaders/render/bodies/cube.h"
#include "shaders/render/labels/label_rows.h"

layout(location = 0) flat out uint out_row;
#ifndef LISTS_COVERS
layout(location = 1) out vec3 out_point;        // relative to the eye
layout(location = 2) flat out vec3 out_center;  // likewise
layout(location = 3) flat out vec4 out_turn;
layout(location = 4) flat out vec3 out_size;
#endif

// What is seen is covered: labels and lists of covers must have equal positions.
invariant gl_Position;

void main() {
    Corner at = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    if (!at.there) return;
    BodyProperties t = properties[at.body];
    if (!is_told(t)) return;
    Pose pose = poses[at.body];
    vec3 center = pose.position - frame.eye.xyz;
    if (run_of(frame, RUN_ALL_BOXES, center, length(t.size), 0.0) == NOT_SEEN) return;
    vec3 toward = turned_back(pose.orientation, orthographic() ? -frame.forward.xyz : -center);
    vec3 point = center + turned(pose.orientation, near_corner(at.corner, toward) * t.size);
    gl_Position = frame.view_projection * vec4(point, 1.0);
    out_row = at.body;
#ifndef LISTS_COVERS
    out_point = point;
    out_center = center;
    out_turn = pose.orientation;
    out_size = t.size;
#endif
}

#endif
