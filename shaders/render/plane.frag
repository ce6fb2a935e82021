// Planes: a ground with a grid of metres and tens of metres that fades into the horizon.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light.h"

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

    float fine = max(line(at.x, wu, 0.012), line(at.y, wv, 0.012));
    float coarse = max(line(at.x * 0.1, wu * 0.1, 0.003), line(at.y * 0.1, wv * 0.1, 0.003));
    vec3 color = vec3(0.34, 0.33, 0.315);
    color = mix(color, color * 0.72, fine);
    color = mix(color, color * 0.50, coarse);
    vec3 shaded = lit(color, point, plane.xyz, ray / length(ray), 0.0);
    out_color = finished(hazed(shaded, distance));
}
