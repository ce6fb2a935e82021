// Legend and caption: quads in pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/scene.h"

layout(std430, set = 0, binding = 7) readonly buffer OverlayTable {
    OverlayQuad quads[];
};
layout(location = 0) out vec2 out_pixel;  // from the upper left corner of the quad
layout(location = 1) flat out uint out_quad;

void main() {
    vec4 r = quads[gl_InstanceIndex].rectangle;
    vec2 side = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
    vec2 at = mix(r.xy, r.zw, side);
    out_pixel = at - r.xy;
    out_quad = gl_InstanceIndex;
    gl_Position = vec4(at / vec2(frame.ray_right.w, frame.ray_down.w) * 2.0 - 1.0, 1.0, 1.0);
}
