// Face clipping: the part of the incident feature over the reference face, reduced to four points.
#ifndef SCREE_PHYSICS_FACE_CLIPPING_H
#define SCREE_PHYSICS_FACE_CLIPPING_H

#include "shaders/physics/collide/convex_support.h"
#include "shaders/physics/collide/manifold.h"
#include "shaders/physics/collide/manifold_reduction.h"

LAWS_BEGIN

// As REDUCE_BIAS (manifold_reduction.h), but nearer to 1: the neighbour of a rim's farthest corner is only 4% worse,
// and must not replace it.
CONSTANT float PATCH_BIAS = 0.98f;

CONSTANT uint PATCH_POINTS = 32u;  // 2 * MOST_SIDES: each clipping side adds one corner at most

// The reference plane: unit normal, and axes in the plane.
struct ReferencePlane {
    vec3 normal;
    float offset;  // of the plane along the normal
    vec3 u;
    vec3 v;
    vec3 middle;  // m
};
LAW vec4 onto_reference_plane(ReferencePlane reference, vec3 point, uint name) {
    vec3 from = point - reference.middle;
    return vec4(dot3(reference.normal, point) - reference.offset, dot3(reference.u, from), dot3(reference.v, from), float(name));
}
LAW vec3 from_reference_plane(ReferencePlane reference, vec4 p, float height) {
    vec3 flat_part = (reference.middle + reference.u * p.y) + reference.v * p.z;
    return flat_part + reference.normal * (height - (dot3(reference.normal, reference.middle) - reference.offset));
}
LAW ReferencePlane reference_plane_of(vec3 normal, float offset, vec3 along, vec3 middle) {
    ReferencePlane reference;
    reference.normal = normal;
    reference.offset = offset;
    reference.u = unit3(along - normal * dot3(along, normal), tangent(normal));
    reference.v = cross3(normal, reference.u);
    reference.middle = middle;
    return reference;
}

// The manifold of an incident feature over a reference face, or over a plane. `sides`: the reference face of `own`
// (points = 0: a plane). `corners`: use that many hull vertices of `other`, all, instead of its feature (0). d: centre
// of `other` from that of `own`, m.
//
// The arrays stay in one function: passed between functions they would be copied, which took drivers a minute to
// compile.
LAW ManifoldBuffer manifold_over(ReferencePlane reference, ConvexShape own, Feature sides, ConvexShape other, Feature across,
                                 uint corners, vec3 d, float ceiling, float flat_within, float margin, Hulls hulls) {
    vec4 points[64];  // x: height; y, z: in the plane, m; w: feature. Two lists of PATCH_POINTS in turn
    uint base = 0u;
    uint count = 0u;
    uint given = corners > 0u ? corners : across.points;
    for (uint k = 0u; k < given; ++k) {
        vec3 corner = across.first;
        if (corners > 0u)
            corner = in_world(other.axes, hull_vertex(hulls, other.hull, k));
        else
            corner = corner_of(other, across, k, hulls);
        vec4 p = onto_reference_plane(reference, d + corner, k);
        p.x = p.x - other.radius;
        if ((sides.points == 0u && p.x >= ceiling) || count >= PATCH_POINTS) continue;
        points[count] = p;
        count = count + 1u;
    }
    // Sutherland-Hodgman clipping (1974) by each side; points to its left, or up to `flat_within` beyond, stay.
    vec4 from = vec4(0.0f);
    for (uint k = 0u; k <= sides.points; ++k) {
        uint side = k == 0u ? sides.points - 1u : k - 1u;  // the last one first, whose end is the start of the first side
        if (sides.points == 0u) break;
        vec4 start = from;
        vec4 to = onto_reference_plane(reference, corner_of(own, sides, side, hulls), 0u);
        from = to;
        if (k == 0u) continue;
        float run_y = to.y - start.y, run_z = to.z - start.z;
        float squared = run_y * run_y + run_z * run_z;
        if (squared < 1.0e-16f) continue;
        float scale = inverse_square_root(squared);
        uint left = 0u, there = PATCH_POINTS - base;
        for (uint i = 0u; i < count; ++i) {
            vec4 p = points[base + i], q = points[base + (i + 1u < count ? i + 1u : 0u)];
            float in_p = (run_y * (p.z - start.z) - run_z * (p.y - start.y)) * scale + flat_within;
            float in_q = (run_y * (q.z - start.z) - run_z * (q.y - start.y)) * scale + flat_within;
            if (in_p >= 0.0f && left < PATCH_POINTS) {
                points[there + left] = p;
                left = left + 1u;
            }
            bool cuts = (in_p < 0.0f) != (in_q < 0.0f) && (count > 2u || i == 0u);
            if (cuts && left < PATCH_POINTS) {
                vec4 cut = p + (q - p) * (in_p * reciprocal(in_p - in_q));
                cut.w = float(64u + 2u * side + (in_p < 0.0f ? 1u : 0u));
                points[there + left] = cut;
                left = left + 1u;
            }
        }
        count = left;
        base = there;
    }
    // At most four, chosen as by best_four() (manifold_reduction.h), the first by its distance from the middle.
    uint low = 0u;
    float lowest = ceiling;
    for (uint k = 0u; k < count; ++k) {
        vec4 p = points[base + k];
        if (p.x >= ceiling) continue;
        points[base + low] = p;
        low = low + 1u;
        lowest = smaller(lowest, p.x);
    }
    ManifoldBuffer touch = manifold_along(reference.normal);
    float above = larger(lowest, 0.0f);
    vec4 a = vec4(0.0f), b = a, c = a;
    float area_abc = 0.0f;
    for (int step = 0; step < 4; ++step) {
        bool few = low <= 4u;
        float best = step == 0 ? -1.0f : flat_within * flat_within;
        bool found = few && uint(step) < low;
        vec4 next = a;
        if (found) next = points[base + uint(step)];
        for (uint k = 0u; k < low && !few; ++k) {
            vec4 p = points[base + k];
            float score = p.x <= lowest + flat_within ? p.y * p.y + p.z * p.z : -1.0f;
            if (step > 0) score = merit(step, a, b, c, area_abc, p) * nearness(p.x - above, flat_within);
            if (PATCH_BIAS * score > best) {
                best = score;
                next = p;
                found = true;
            }
        }
        if (!found) break;
        touch = with_point(touch, from_reference_plane(reference, next, 0.5f * next.x), next.x, uint(next.w), margin);
        if (step == 0) a = next;
        if (step <= 1) b = next;
        if (step <= 2) c = next;
        area_abc = area_right_of(a, b, c);
    }
    return touch;
}

LAWS_END

#endif
