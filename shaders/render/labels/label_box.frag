// Labels of boxes: where the ray of the pixel meets the box, by the law of rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/labels/label.h"
#include "shaders/render/labels/ray_law.h"

layout(location = 0) flat in uint row;
layout(location = 1) in vec3 point;
layout(location = 2) flat in vec3 center;
layout(location = 3) flat in vec4 turn;
layout(location = 4) flat in vec3 size;

void main() {
    vec3 start = ray_start(gl_FragCoord.xy) - center, along = ray_direction(gl_FragCoord.xy);
    float way = -dot(start, along) / dot(along, along);
    vec3 at = turned_back(turn, start + along * way), ahead = turned_back(turn, along);
    float straight = dot(point, frame.forward.xyz), depth = way + span_in_box(at, ahead, size).enter;
    // Rounding may let a ray pass by an edge.
    if (!(abs(depth - straight) < 0.001 * abs(straight))) depth = straight;
    tell(row, turned(turn, normal_of_box(size, at + ahead * (depth - way), ahead)), depth);
}
