// Spheres, ellipsoids and capsules, with the analytic normal of the shape instead of the mesh's.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light.h"

layout(location = 0) in vec3 mesh_point;
layout(location = 1) flat in vec4 center_radius;
layout(location = 2) flat in vec4 axis_height;
layout(location = 3) flat in vec4 turn;
layout(location = 4) flat in vec4 color;
layout(location = 0) out vec4 out_color;

void main() {
    vec3 from_center = mesh_point - center_radius.xyz;
    float s = clamp(dot(axis_height.xyz, from_center), -axis_height.w, axis_height.w);
    vec3 normal = normalize(from_center - axis_height.xyz * s);
    vec3 point = center_radius.xyz + axis_height.xyz * s + normal * center_radius.w;
    // Two tones by octant of the body frame, to make rolling visible.
    vec3 own = turned_back(turn, normal);
    float radius = center_radius.w;
    if (axis_height.w < 0.0) {
        vec3 radii = axis_height.xyz;
        own = normalize(turned_back(turn, from_center) / radii);
        normal = normalize(turned(turn, own / radii));
        point = center_radius.xyz + turned(turn, own * radii);
        radius = min(radii.x, min(radii.y, radii.z));
    }
    float soft = 0.8 * pixel_at(point) / radius + 0.01;
    vec3 halves = clamp(own / soft, -1.0, 1.0);
    float tone = 0.87 + 0.13 * halves.x * halves.y * halves.z;
    vec3 shaded = lit(color.rgb * tone, point, normal, sight_to(point), 0.9) + color.rgb * (0.12 * color.a * color.a);
    out_color = finished(hazed(shaded, length(point)));
}
