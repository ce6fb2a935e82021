// Tones of cylinders, cones, hulls and meshes, by which faces and turning are told apart.
#ifndef SCREE_RENDER_SOLID_TONE_H
#define SCREE_RENDER_SOLID_TONE_H

#include "shaders/render/light.h"

// Two tones by quadrant about the axis, to make rolling visible; a hull's faces differ by their normals. `own`, `edge`: as
// solid_corner.h passes them.
float tone_of(vec3 own, vec3 local_normal, vec2 edge, vec3 point) {
    vec2 halves = clamp(own.xz / 0.02, -1.0, 1.0);
    float tone = 0.9 + 0.1 * halves.x * halves.y + 0.05 * local_normal.x * (own.x == 0.0 && own.z == 0.0 ? 1.0 : 0.0);
    if (edge.y > 0.0) {
        float pixel = pixel_at(point);
        float bevel = max(edge.y, 1.2 * pixel), shown = clamp(edge.y / (1.8 * pixel), 0.0, 1.0);
        float lift = clamp(1.0 - edge.x / bevel, 0.0, 1.0);
        tone *= 1.0 + 0.22 * shown * shown * lift * lift;
        tone *= 1.0 - seam_at(edge.x, pixel, 14.0 * edge.y) * (1.0 - 0.5 * shown);
    }
    return tone;
}

#endif
