// Manifold reduction: the four of up to eight points that support best.
#ifndef SCREE_PHYSICS_MANIFOLD_REDUCTION_H
#define SCREE_PHYSICS_MANIFOLD_REDUCTION_H

#include "shaders/physics/collide/rectangle_clipping.h"

LAWS_BEGIN

// A later point must beat an earlier one by this factor, so that rounding does not change the choice between frames (as
// Box3D's b3ReduceManifoldPoints, which uses the same four steps).
CONSTANT float REDUCE_BIAS = 0.95f;

// Twice the signed area (m^2) of a, b, p in the plane of y and z, > 0 if p is to the right of a to b.
LAW float area_right_of(vec4 a, vec4 b, vec4 p) {
    return (p.y - a.y) * (b.z - a.z) - (p.z - a.z) * (b.y - a.y);
}

// Score of p after a (distance), after a and b (triangle area), after a, b and c (outside distance as area; area_abc:
// area_right_of(a, b, c)).
LAW float merit(uint step, vec4 a, vec4 b, vec4 c, float area_abc, vec4 p) {
    float y = p.y - a.y;
    float z = p.z - a.z;
    float beyond_ab = area_right_of(a, b, p);
    float beyond_bc = area_right_of(b, c, p);
    float beyond_ca = area_right_of(c, a, p);
    if (step == 1u) return y * y + z * z;
    if (step == 2u) return abs(beyond_ab);
    if (area_abc > 0.0f) return -smaller(beyond_ab, smaller(beyond_bc, beyond_ca));
    return larger(beyond_ab, larger(beyond_bc, beyond_ca));
}

// Weight of a point: 1 in contact (or if it is the lowest of those apart), a quarter at `slop` (m) above, less beyond.
// Without it, or with ten times the slop, far corners in the air displaced one that carried, and boxes rocked for ever
// between two choices.
LAW float nearness(float height, float slop) {
    float near = height > 0.0f ? slop * reciprocal(slop + height) : 1.0f;
    return near * near;
}

// Bits of the chosen corners below the ceiling (m): the lowest (of those within `flat_within` (m) of it, the farthest
// from the rectangle's middle), the farthest from that, the one of the largest triangle, and the one farthest outside
// of it. All if there are at most four. If the first were any low corner, it could be the crossing of two nearly
// parallel sides in the middle of a face's edge, and a corner would be left unsupported.
LAW uint best_four(ClipCorners corners, float ceiling, float flat_within) {
    uint present = 0u;
    uint count = 0u;
    uint chosen = 0u;
    float lowest = ceiling;
    for (uint k = 0u; k < CLIP_CANDIDATES; ++k) {
        vec4 p = clip_corner(corners, k);
        if (p.w >= 0.0f && p.x < ceiling) {
            present = present | (1u << k);
            count = count + 1u;
            lowest = smaller(lowest, p.x);
        }
    }
    if (count <= 4u) return present;
    vec4 a = vec4(0.0f);
    float farthest = -1.0f;
    for (uint k = 0u; k < CLIP_CANDIDATES; ++k) {
        if ((present & (1u << k)) != 0u) {
            vec4 p = clip_corner(corners, k);
            float away = p.y * p.y + p.z * p.z;
            if (p.x <= lowest + flat_within && REDUCE_BIAS * away > farthest) {
                a = p;
                farthest = away;
                chosen = 1u << k;
            }
        }
    }
    float reference = larger(lowest, 0.0f);
    vec4 b = a;
    vec4 c = a;
    float area_abc = 0.0f;
    for (uint step = 1u; step < 4u; ++step) {
        float best = flat_within * flat_within;
        uint bit = 0u;
        vec4 next = a;
        for (uint k = 0u; k < CLIP_CANDIDATES; ++k) {
            if ((present & (1u << k)) != 0u) {
                vec4 p = clip_corner(corners, k);
                float score = merit(step, a, b, c, area_abc, p) * nearness(p.x - reference, flat_within);
                if (REDUCE_BIAS * score > best) {
                    best = score;
                    bit = 1u << k;
                    next = p;
                }
            }
        }
        if (bit == 0u) return chosen;
        chosen = chosen | bit;
        if (step == 1u) b = next;
        if (step == 2u) c = next;
        area_abc = area_right_of(a, b, c);
    }
    return chosen;
}

LAWS_END

#endif
