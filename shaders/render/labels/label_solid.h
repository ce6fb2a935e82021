// A fragment of a hull or a mesh: where the ray of the pixel meets the triangle's plane.
#ifndef SCREE_RENDER_LABEL_SOLID_H
#define SCREE_RENDER_LABEL_SOLID_H

#include "shaders/render/labels/label.h"

layout(location = 0) in vec3 point;
layout(location = 1) flat in vec3 corner;
layout(location = 2) flat in vec3 normal;
layout(location = 3) flat in uint row;

void main() {
    float straight = dot(point, frame.forward.xyz);
    vec3 start = ray_start(gl_FragCoord.xy), along = ray_direction(gl_FragCoord.xy);
    float depth = dot(normal, corner - start) / dot(normal, along);
    // Slivers and grazing rays have no plane worth the name.
    if (!(abs(depth - straight) < 0.001 * abs(straight))) depth = straight;
    tell(row, normal, depth);
}

#endif
