// Cylinders, cones, hulls and meshes: shading.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light.h"

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 own;
layout(location = 3) flat in vec4 turn;
layout(location = 4) flat in vec4 color;
layout(location = 0) out vec4 out_color;

void main() {
    vec3 local = normalize(normal);
    // Two tones by quadrant about the axis, to make rolling visible; a hull's faces differ by their normals.
    vec2 halves = clamp(own.xz / 0.02, -1.0, 1.0);
    float tone = 0.9 + 0.1 * halves.x * halves.y + 0.05 * local.x * (own.x == 0.0 && own.z == 0.0 ? 1.0 : 0.0);
    vec3 shaded =
        lit(color.rgb * tone, point, turned(turn, local), sight_to(point), 0.7) + color.rgb * (0.12 * color.a * color.a);
    out_color = finished(hazed(shaded, length(point)));
}
