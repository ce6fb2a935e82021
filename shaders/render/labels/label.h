// What a fragment tells: of the body that it shows normal, depth and row, or that a body covers its pixel, whatever hides it
// there.
#ifndef SCREE_RENDER_LABEL_H
#define SCREE_RENDER_LABEL_H

#include "shaders/render/scene.h"

// As the rays of the channels begin: at the near plane, in parallel views where the picture begins.
float depth_in_clip_space(float depth) {
    return orthographic() ? frame.view_projection[3][2] - depth * frame.pixel.w : frame.ray_corner.w / depth;
}
bool is_ahead(float depth) {
    float at = depth_in_clip_space(depth);
    return at > 0.0 && at < 1.0;
}

#ifdef LISTS_COVERS
layout(std430, set = 0, binding = 25) buffer CoverTable {
    uint covers;      // so many there are
    uint room;        // for so many
    uvec2 covered[];  // row and pixel, counted row by row from the upper left
};
void tell(uint row, vec3 normal, float depth) {
    if (gl_FragCoord.y < frame.joints.z || gl_FragCoord.y > frame.joints.w) return;
    uint place = atomicAdd(covers, 1u);
    uint pixel = uint(gl_FragCoord.y) * uint(frame.ray_right.w) + uint(gl_FragCoord.x);
    if (place < room) covered[place] = uvec2(row, pixel);
}
#else
layout(location = 0) out uvec4 out_label;  // bits of the normal, as an octahedron unfolded, and of the depth, m; row

// Cigolle et al. 2014, A survey of efficient representations for independent unit vectors.
void tell(uint row, vec3 normal, float depth) {
    vec3 n = normal / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    out_label = uvec4(floatBitsToUint(n.z < 0.0 ? folded : n.xy), floatBitsToUint(depth), row);
}
#endif

#endif
