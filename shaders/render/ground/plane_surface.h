// The surface of planes: a ground that gives scale (ground.h). ground_lit() is that of the including shader.
#ifndef SCREE_RENDER_PLANE_SURFACE_H
#define SCREE_RENDER_PLANE_SURFACE_H

#include "shaders/render/ground.h"
#include "shaders/render/light.h"

// Shaded colour of the ground; `point` relative to the eye, m, `direction` from the eye to it, unit.
vec3 ground_lit(vec3 color, vec3 point, vec3 normal, vec3 direction);

layout(location = 0) flat in vec4 plane;
layout(location = 1) flat in vec4 axis_u;
layout(location = 2) flat in vec4 axis_v;
layout(location = 0) out vec4 out_color;

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
    vec3 shaded = ground_lit(ground_color(at, vec2(wu, wv)), point, plane.xyz, ray / length(ray));
    out_color = finished(hazed(shaded, distance));
}

#endif
