// Boxes: the 36 corners of 12 triangles, made from gl_VertexIndex.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/coloring.h"
#include "shaders/render/cube.h"

layout(location = 0) out vec3 out_point;      // relative to the eye
layout(location = 1) out vec3 out_own;        // in the body's frame
layout(location = 2) flat out vec4 out_size;  // half extents; w: the axis of this face, 0 to 2
layout(location = 3) flat out vec4 out_turn;
layout(location = 4) flat out vec4 out_color;  // w: how far up the colour scale

void main() {
    uint body = instances[gl_InstanceIndex];
    Traits t = traits[body];
    Pose pose = poses[body];
    vec3 own = cube_corner(gl_VertexIndex) * t.size;
    vec3 point = pose.position - frame.eye.xyz + turned(pose.orientation, own);
    out_point = point;
    out_own = own;
    out_size = vec4(t.size, float((gl_VertexIndex / 6) % 3));
    out_turn = pose.orientation;
    out_color = body_color(body);
    gl_Position = frame.view_projection * vec4(point, 1.0);
}
