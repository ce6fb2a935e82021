// Cylinders, cones, hulls and meshes: shading.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/bodies/solid_tone.h"

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 own;
layout(location = 3) flat in vec4 turn;
layout(location = 4) flat in vec4 color;
layout(location = 5) in vec2 edge;  // distance to the edge of a hull's face, width of its edges; 0: none, m
layout(location = 0) out vec4 out_color;

void main() {
    vec3 local = normalize(normal);
    float tone = tone_of(own, local, edge, point);
    vec3 shaded =
        lit(color.rgb * tone, point, turned(turn, local), sight_to(point), 0.7) + color.rgb * (0.12 * color.a * color.a);
    out_color = finished(hazed(shaded, length(point)));
}
