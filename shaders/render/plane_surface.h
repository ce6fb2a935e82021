// The surface of planes: a ground that gives scale, with tiles and lines of metres and tens of metres, and of decimetres near
// the eye. ground_lit() is that of the including shader.
#ifndef SCREE_RENDER_PLANE_SURFACE_H
#define SCREE_RENDER_PLANE_SURFACE_H

#include "shaders/render/light.h"

// Shaded colour of the ground; `point` relative to the eye, m, `direction` from the eye to it, unit.
vec3 ground_lit(vec3 color, vec3 point, vec3 normal, vec3 direction);

layout(location = 0) flat in vec4 plane;
layout(location = 1) flat in vec4 axis_u;
layout(location = 2) flat in vec4 axis_v;
layout(location = 0) out vec4 out_color;

// Integral of a grid line of `half_width` around every integer, from 0 to x: differences give box-filtered lines.
float covered_up_to(float x, float half_width) {
    return floor(x + 0.5) * 2.0 * half_width + clamp(fract(x + 0.5) - 0.5, -half_width, half_width);
}
float line(float x, float w, float half_width) {
    return (covered_up_to(x + 0.5 * w, half_width) - covered_up_to(x - 0.5 * w, half_width)) / w;
}

// Tiles of alternating tone, box-filtered: 0 or 1, far away a half.
float tiles(vec2 x, vec2 w) {
    vec2 i = 2.0 * (abs(fract((x - 0.5 * w) * 0.5) - 0.5) - abs(fract((x + 0.5 * w) * 0.5) - 0.5)) / w;
    return 0.5 - 0.5 * i.x * i.y;
}

void main() {
    vec3 start = ray_start(gl_FragCoord.xy), ray = ray_direction(gl_FragCoord.xy);
    float sinking = -dot(plane.xyz, ray);
    float t = (plane.w + dot(plane.xyz, start)) / max(sinking, 1e-6);
    vec3 point = start + ray * t;
    float distance = length(point);
    vec2 at = vec2(axis_u.w + dot(axis_u.xyz, point), axis_v.w + dot(axis_v.xyz, point));
    // Distances to the neighbouring pixels on the plane.
    float spread = orthographic() ? 1.0 : t;
    vec3 to_right = (frame.ray_right.xyz + ray * (dot(plane.xyz, frame.ray_right.xyz) / max(sinking, 1e-6))) * spread;
    vec3 to_below = (frame.ray_down.xyz + ray * (dot(plane.xyz, frame.ray_down.xyz) / max(sinking, 1e-6))) * spread;
    float wu = max(abs(dot(axis_u.xyz, to_right)) + abs(dot(axis_u.xyz, to_below)), 1e-6);
    float wv = max(abs(dot(axis_v.xyz, to_right)) + abs(dot(axis_v.xyz, to_below)), 1e-6);

    vec2 w = vec2(wu, wv);
    // Decimetres show where a pixel is at most a centimetre.
    float near = 1.0 - smoothstep(0.006, 0.02, max(wu, wv));
    float finest = near * max(line(at.x * 10.0, wu * 10.0, 0.012), line(at.y * 10.0, wv * 10.0, 0.012));
    // Metres fade where a tile is a few pixels wide: they would flicker, and look like a weave.
    float metres = 1.0 - smoothstep(0.08, 0.3, max(wu, wv));
    float fine = metres * max(line(at.x, wu, 0.012), line(at.y, wv, 0.012));
    float coarse = max(line(at.x * 0.1, wu * 0.1, 0.003), line(at.y * 0.1, wv * 0.1, 0.003));
    vec3 color = vec3(0.335, 0.33, 0.32);
    color *= 1.0 - 0.05 * mix(0.5, tiles(at, w), metres) - 0.06 * tiles(at * 0.1, w * 0.1);
    color *= 1.0 - 0.10 * finest - 0.24 * fine;
    color = mix(color, color * 0.55, coarse);
    vec3 shaded = ground_lit(color, point, plane.xyz, ray / length(ray));
    out_color = finished(hazed(shaded, distance));
}

#endif
