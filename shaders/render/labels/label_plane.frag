// Labels of planes, which are not seen from behind.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/labels/label.h"

layout(location = 0) flat in vec4 plane;
layout(location = 1) flat in uint row;

void main() {
    vec3 start = ray_start(gl_FragCoord.xy), along = ray_direction(gl_FragCoord.xy);
    float sinking = -dot(plane.xyz, along), depth = (plane.w + dot(plane.xyz, start)) / sinking;
    if (sinking < 1e-6 * length(along) || !is_ahead(depth)) discard;
    gl_FragDepth = depth_in_clip_space(depth);
    tell(row, plane.xyz, depth);
}
