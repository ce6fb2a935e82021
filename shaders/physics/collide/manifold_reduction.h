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
LAW float merit(int step, vec4 a, vec4 b, vec4 c, float area_abc, vec4 p) {
    float y = p.y - a.y;
    float z = p.z - a.z;
    float beyond_ab = area_right_of(a, b, p);
    float beyond_bc = area_right_of(b, c, p);
    float beyond_ca = area_right_of(c, a, p);
    if (step == 1) return y * y + z * z;
    if (step == 2) return abs(beyond_ab);
    return choose(area_abc > 0.0f, -smaller(beyond_ab, smaller(beyond_bc, beyond_ca)),
                  larger(beyond_ab, larger(beyond_bc, beyond_ca)));
}

// Weight of a point: 1 in contact (or if it is the lowest of those apart), a quarter at `slop` (m) above, less beyond.
// Without it, or with ten times the slop, far corners in the air displaced one that carried, and boxes rocked for ever
// between two choices.
LAW float nearness(float height, float slop) {
    float near = choose(height > 0.0f, slop * reciprocal(slop + height), 1.0f);
    return near * near;
}

// Bits of the chosen corners below the ceiling (m): the lowest (of those within `flat_within` (m) of it, the farthest
// from the rectangle's middle), the farthest from that, the one of the largest triangle, and the one farthest outside
// of it. All if there are at most four. If the first were any low corner, it could be the crossing of two nearly
// parallel sides in the middle of a face's edge, and a corner would be left unsupported.
LAW uint best_four(ClipCorners corners, float ceiling, float flat_within) {
    uint present = 0u;
    uint count = 0u;
    float lowest = ceiling;
    for (int k = 0; k < CLIP_CANDIDATES; ++k) {
        vec4 p = clip_corner(corners, k);
        bool there = p.w >= 0.0f && p.x < ceiling;
        present = choose(there, present | (1u << k), present);
        count = choose(there, count + 1u, count);
        lowest = choose(there, smaller(lowest, p.x), lowest);
    }
    bool too_many = count > 4u;
    if (none(too_many)) return present;
    uint chosen = 0u;
    vec4 a = vec4(0.0f);
    float farthest = -1.0f;
    for (int k = 0; k < CLIP_CANDIDATES; ++k) {
        bool there = too_many && (present & (1u << k)) != 0u;
        if (!none(there)) {
            vec4 p = clip_corner(corners, k);
            float away = p.y * p.y + p.z * p.z;
            bool better = there && p.x <= lowest + flat_within && REDUCE_BIAS * away > farthest;
            a = choose(better, p, a);
            farthest = choose(better, away, farthest);
            chosen = choose(better, uint(1u << k), chosen);
        }
    }
    float reference = larger(lowest, 0.0f);
    vec4 b = a;
    vec4 c = a;
    float area_abc = 0.0f;
    bool goes_on = too_many;
    for (int step = 1; step < 4 && !none(goes_on); ++step) {
        float best = flat_within * flat_within;
        uint bit = 0u;
        vec4 next = a;
        for (int k = 0; k < CLIP_CANDIDATES; ++k) {
            bool there = goes_on && (present & (1u << k)) != 0u;
            if (!none(there)) {
                vec4 p = clip_corner(corners, k);
                float score = merit(step, a, b, c, area_abc, p) * nearness(p.x - reference, flat_within);
                bool better = there && REDUCE_BIAS * score > best;
                best = choose(better, score, best);
                bit = choose(better, uint(1u << k), bit);
                next = choose(better, p, next);
            }
        }
        goes_on = goes_on && bit != 0u;
        chosen = chosen | bit;
        if (step == 1) b = next;
        if (step == 2) c = next;
        area_abc = area_right_of(a, b, c);
    }
    return choose(too_many, chosen, present);
}

LAWS_END

#endif
