// Cylinders, cones, hulls and meshes: shading.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light.h"

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 own;
layout(location = 3) flat in vec4 turn;
layout(location = 4) flat in vec4 color;
layout(location = 5) in vec2 edge;  // distance to the edge of a hull's face, width of its edges; 0: none, m
layout(location = 0) out vec4 out_color;

void main() {
    vec3 local = normalize(normal);
    // Two tones by quadrant about the axis, to make rolling visible; a hull's faces differ by their normals.
    vec2 halves = clamp(own.xz / 0.02, -1.0, 1.0);
    float tone = 0.9 + 0.1 * halves.x * halves.y + 0.05 * local.x * (own.x == 0.0 && own.z == 0.0 ? 1.0 : 0.0);
    if (edge.y > 0.0) {
        float pixel = pixel_at(point);
        float bevel = max(edge.y, 1.2 * pixel), shown = clamp(edge.y / (1.8 * pixel), 0.0, 1.0);
        float lift = clamp(1.0 - edge.x / bevel, 0.0, 1.0);
        tone *= 1.0 + 0.22 * shown * shown * lift * lift;
        tone *= 1.0 - seam_at(edge.x, pixel, 14.0 * edge.y) * (1.0 - 0.5 * shown);
    }
    vec3 shaded =
        lit(color.rgb * tone, point, turned(turn, local), sight_to(point), 0.7) + color.rgb * (0.12 * color.a * color.a);
    out_color = finished(hazed(shaded, length(point)));
}
