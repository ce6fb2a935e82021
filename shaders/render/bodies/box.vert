// Boxes: the seven vertices of the three faces towards the eye.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/batch.h"
#include "shaders/render/bodies/cube.h"

layout(location = 0) out vec3 out_point;      // relative to the eye
layout(location = 1) out vec3 out_own;        // in the body's frame
layout(location = 2) flat out vec4 out_size;  // half extents
layout(location = 3) flat out vec4 out_turn;
layout(location = 4) flat out vec4 out_color;  // w: position on the colour scale

// The depth prepass and the shading pass must give equal positions.
invariant gl_Position;

void main() {
    Corner at = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    if (!at.there) return;
    Pose pose = poses[at.body];
    vec3 center = pose.position - frame.eye.xyz;
    // At least a pixel wide, to avoid flicker.
    vec3 size = max(properties[at.body].size, vec3(0.5 * pixel_at(center)));
    vec3 toward = turned_back(pose.orientation, orthographic() ? -frame.forward.xyz : -center);
    vec3 own = near_corner(at.corner, toward) * size;
    vec3 point = center + turned(pose.orientation, own);
    out_point = point;
    out_own = own;
    out_size = vec4(size, 0.0);
    out_turn = pose.orientation;
    out_color = tints[at.body];
    gl_Position = frame.view_projection * vec4(point, 1.0);
}
