// The way between two convex cores that are apart: the algorithm of Gilbert, Johnson and Keerthi (IEEE J. Robotics and Automation
// 4, 1988), with the nearest point of a simplex by its Voronoi regions (Ericson, Real-Time Collision Detection, 2005, 5.1).
#ifndef SCREE_PHYSICS_NEAREST_H
#define SCREE_PHYSICS_NEAREST_H

#include "shaders/physics/solid.h"

LAWS_BEGIN

// Fewer, and the way between two rims is found to a degree only.
CONSTANT uint NEAREST_ROUNDS = 24u;
// Of the squared distance: what counts as no progress. With less, rounding ends the search.
CONSTANT float NEAREST_PROGRESS = 1.0e-6f;

// Some points of the difference of two bodies, and of what they span the point nearest to 0.
struct Simplex {
    vec3 nearest;
    uint count;  // 1 to 3; while it is made, 4
    vec3 a;
    float pad_a;
    vec3 b;
    float pad_b;
    vec3 c;
    float pad_c;
};
LAW Simplex simplex_of(vec3 nearest, uint count, vec3 a, vec3 b, vec3 c) {
    Simplex simplex;
    simplex.nearest = nearest;
    simplex.count = count;
    simplex.a = a;
    simplex.b = b;
    simplex.c = c;
    simplex.pad_a = 0.0f;
    simplex.pad_b = 0.0f;
    simplex.pad_c = 0.0f;
    return simplex;
}

LAW Simplex nearest_on_segment(vec3 a, vec3 b) {
    vec3 ab = b - a;
    float t = -dot3(a, ab);
    float whole = dot3(ab, ab);
    if (t <= 0.0f || whole < 1.0e-24f) return simplex_of(a, 1u, a, a, a);
    if (t >= whole) return simplex_of(b, 1u, b, b, b);
    return simplex_of(a + ab * (t * reciprocal(whole)), 2u, a, b, b);
}

LAW Simplex nearest_on_triangle(vec3 a, vec3 b, vec3 c) {
    vec3 ab = b - a, ac = c - a;
    float d1 = -dot3(ab, a), d2 = -dot3(ac, a);
    if (d1 <= 0.0f && d2 <= 0.0f) return simplex_of(a, 1u, a, a, a);
    float d3 = -dot3(ab, b), d4 = -dot3(ac, b);
    if (d3 >= 0.0f && d4 <= d3) return simplex_of(b, 1u, b, b, b);
    float d5 = -dot3(ab, c), d6 = -dot3(ac, c);
    if (d6 >= 0.0f && d5 <= d6) return simplex_of(c, 1u, c, c, c);
    if (d1 * d4 - d3 * d2 <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return nearest_on_segment(a, b);
    if (d5 * d2 - d1 * d6 <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return nearest_on_segment(a, c);
    if (d3 * d6 - d5 * d4 <= 0.0f && d4 >= d3 && d5 >= d6) return nearest_on_segment(b, c);
    vec3 normal = cross3(ab, ac);
    float squared = dot3(normal, normal);
    if (squared < 1.0e-24f) return nearest_on_segment(a, b);
    return simplex_of(normal * (dot3(normal, a) * reciprocal(squared)), 3u, a, b, c);
}

// With one more point. Of four, 0 lies outside of what they span, so the nearest point lies on one of the three new faces.
LAW Simplex with_corner(Simplex s, vec3 p) {
    if (s.count == 0u) return simplex_of(p, 1u, p, p, p);
    if (s.count == 1u) return nearest_on_segment(s.a, p);
    Simplex best = s;
    float least = 1.0e30f;
    uint faces = s.count == 2u ? 1u : 3u;
    for (uint k = 0u; k < faces; ++k) {  // a, b; a, c; b, c
        Simplex face = nearest_on_triangle(k == 2u ? s.b : s.a, k == 0u ? s.b : s.c, p);
        float squared = dot3(face.nearest, face.nearest);
        if (squared < least) {
            least = squared;
            best = face;
        }
    }
    return best;
}

// The point of B less the point of A that reach farthest against each other along a direction from A to B; d: B's centre less
// A's.
LAW vec3 difference_along(Solid a, Solid b, vec3 d, vec3 direction, Hulls hulls) {
    return (d + support_of(b, -direction, hulls)) - support_of(a, direction, hulls);
}

// Where the shortest way from A's core to B's is found: its `nearest`, m; `start`: a direction to begin with. Where they overlap,
// any short way.
LAW Simplex way_between(Solid a, Solid b, vec3 d, vec3 start, Hulls hulls) {
    Simplex simplex = simplex_of(start, 0u, start, start, start);
    for (uint k = 0u; k < NEAREST_ROUNDS; ++k) {
        vec3 way = simplex.nearest;
        float squared = dot3(way, way);
        if (squared < 1.0e-20f) break;
        vec3 corner = difference_along(a, b, d, way, hulls);
        bool first = simplex.count == 0u;
        if (!first && squared - dot3(way, corner) <= NEAREST_PROGRESS * squared) break;
        Simplex next = with_corner(simplex, corner);
        if (!first && dot3(next.nearest, next.nearest) >= squared) break;
        simplex = next;
    }
    return simplex;
}

LAWS_END

#endif
