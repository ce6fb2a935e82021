// Lines over the picture: clipping at the near plane, and vertices of screen-space lines.
#ifndef SCREE_RENDER_LINES_H
#define SCREE_RENDER_LINES_H

#include "shaders/render/scene.h"

// Vertices of two triangles: 0 or 1 along the line, -1 or 1 across it.
const vec2 SIDES[6] = vec2[](vec2(0, -1), vec2(1, -1), vec2(1, 1), vec2(0, -1), vec2(1, 1), vec2(0, 1));

float near_plane() {
    return frame.ray_corner.w;
}
vec2 pixels_of(vec4 clip) {
    return (clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.ray_right.w, frame.ray_down.w);
}
float depth_of(vec4 clip) {
    return clip.z / clip.w;
}
void place(vec2 pixel, float depth) {
    gl_Position = vec4(pixel / vec2(frame.ray_right.w, frame.ray_down.w) * 2.0 - 1.0, clamp(depth, 0.0, 1.0), 1.0);
}

// Clips a line at the near plane. Returns false if nothing is left.
bool clip_line(inout vec4 from, inout vec4 to) {
    float near = near_plane();
    if (from.w < near && to.w < near) return false;
    if (from.w < near) from = mix(to, from, (to.w - near) / (to.w - from.w));
    if (to.w < near) to = mix(from, to, (from.w - near) / (from.w - to.w));
    return true;
}

#endif
