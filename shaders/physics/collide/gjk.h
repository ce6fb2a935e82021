// Distance between two disjoint convex cores: Gilbert, Johnson and Keerthi (IEEE J. Robotics and Automation 4, 1988),
// with the nearest point of a simplex by its Voronoi regions (Ericson, Real-Time Collision Detection, 2005, 5.1).
#ifndef SCREE_PHYSICS_GJK_H
#define SCREE_PHYSICS_GJK_H

#include "shaders/physics/collide/convex_support.h"

LAWS_BEGIN

// With fewer, the direction between two rims is accurate to a degree only.
CONSTANT uint NEAREST_ROUNDS = 24u;
// Relative progress of the squared distance below which the search ends. With less, rounding ends it.
CONSTANT float NEAREST_PROGRESS = 1.0e-6f;

// A simplex of points of the Minkowski difference, and its point nearest to the origin.
struct Simplex {
    vec3 nearest;
    uint count;  // 1 to 3
    vec3 a;
    vec3 b;
    vec3 c;
};
LAW Simplex simplex_of(vec3 nearest, uint count, vec3 a, vec3 b, vec3 c) {
    Simplex simplex;
    simplex.nearest = nearest;
    simplex.count = count;
    simplex.a = a;
    simplex.b = b;
    simplex.c = c;
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
    float d3 = -dot3(ab, b), d4 = -dot3(ac, b);
    float d5 = -dot3(ab, c), d6 = -dot3(ac, c);
    vec3 normal = cross3(ab, ac);
    float squared = dot3(normal, normal);
    // Voronoi region: a corner is treated as a degenerate side, so that only one place computes the nearest point of a
    // side.
    vec3 p = a, q = b;
    if (d1 <= 0.0f && d2 <= 0.0f) {
        q = a;
    } else if (d3 >= 0.0f && d4 <= d3) {
        p = b;
    } else if (d6 >= 0.0f && d5 <= d6) {
        p = c;
        q = c;
    } else if (d1 * d4 - d3 * d2 <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
        q = b;
    } else if (d5 * d2 - d1 * d6 <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
        q = c;
    } else if (d3 * d6 - d5 * d4 <= 0.0f && d4 >= d3 && d5 >= d6) {
        p = b;
        q = c;
    } else if (squared >= 1.0e-24f) {
        return simplex_of(normal * (dot3(normal, a) * reciprocal(squared)), 3u, a, b, c);
    }
    return nearest_on_segment(p, q);
}

// The sub-simplex of a, b, c and p that holds the point nearest to the origin, if p belongs to it (it does where p
// brings the points nearer): p, a side, or a face with the origin in front. By the Voronoi regions around p, from dot
// products of the edges at p (missing points equal others and select no region).
LAW Simplex with_corner(Simplex s, vec3 p) {
    if (s.count == 0u) return simplex_of(p, 1u, p, p, p);
    vec3 ea = s.a - p, eb = s.b - p, ec = s.c - p;
    float aa = dot3(ea, ea), bb = dot3(eb, eb), cc = dot3(ec, ec);
    float ab = dot3(ea, eb), ac = dot3(ea, ec), bc = dot3(eb, ec);
    float pa = -dot3(p, ea), pb = -dot3(p, eb), pc = -dot3(p, ec);
    // a_to_b: signed distance (scaled) of the origin from the edge p-a, towards b; and so on.
    float a_to_b = aa * pb - ab * pa, b_to_a = bb * pa - ab * pb;
    float a_to_c = aa * pc - ac * pa, c_to_a = cc * pa - ac * pc;
    float b_to_c = bb * pc - bc * pb, c_to_b = cc * pb - bc * pc;
    vec3 n_ab = cross3(ea, eb), n_ac = cross3(ea, ec), n_bc = cross3(eb, ec);
    float volume = dot3(n_ab, ec);
    bool no_fourth = s.count < 3u;
    bool over_ab = a_to_b > 0.0f && b_to_a > 0.0f && (aa * bb - ab * ab) - (a_to_b + b_to_a) > 0.0f;
    bool over_ac = a_to_c > 0.0f && c_to_a > 0.0f && (aa * cc - ac * ac) - (a_to_c + c_to_a) > 0.0f;
    bool over_bc = b_to_c > 0.0f && c_to_b > 0.0f && (bb * cc - bc * bc) - (b_to_c + c_to_b) > 0.0f;
    bool before_ab = no_fourth || (dot3(n_ab, p) >= 0.0f) == (volume >= 0.0f);
    bool before_ac = (dot3(n_ac, p) <= 0.0f) == (volume >= 0.0f);
    bool before_bc = (dot3(n_bc, p) >= 0.0f) == (volume >= 0.0f);
    vec3 normal = n_ab, first = s.a, second = s.b;
    bool face = over_ab && before_ab;
    if (!face && over_ac && before_ac) {
        face = true;
        normal = n_ac;
        second = s.c;
    }
    if (!face && over_bc && before_bc) {
        face = true;
        normal = n_bc;
        first = s.b;
        second = s.c;
    }
    float squared = dot3(normal, normal);
    if (face && squared >= 1.0e-24f) return simplex_of(normal * (dot3(normal, p) * reciprocal(squared)), 3u, first, second, p);
    first = p;
    if (pa > 0.0f && a_to_b <= 0.0f && a_to_c <= 0.0f) {
        first = s.a;
    } else if (pb > 0.0f && b_to_a <= 0.0f && b_to_c <= 0.0f) {
        first = s.b;
    } else if (pc > 0.0f && c_to_a <= 0.0f && c_to_b <= 0.0f) {
        first = s.c;
    }
    return nearest_on_segment(first, p);
}

// Support point of the Minkowski difference B - A against `direction` (from A to B); d: centre of B minus centre of A.
LAW vec3 minkowski_support(ConvexShape a, ConvexShape b, vec3 d, vec3 direction, Hulls hulls) {
    return (d + support_of(b, -direction, hulls)) - support_of(a, direction, hulls);
}

// Runs GJK: `nearest` is the shortest vector from A's core to B's, m; `start`: initial direction. For overlapping
// cores, some short vector.
LAW Simplex gjk_closest(ConvexShape a, ConvexShape b, vec3 d, vec3 start, Hulls hulls) {
    Simplex simplex = simplex_of(start, 0u, start, start, start);
    bool nearer = true;
    for (uint k = 0u; k < NEAREST_ROUNDS && nearer; ++k) {
        vec3 way = simplex.nearest;
        float squared = dot3(way, way);
        nearer = squared >= 1.0e-20f;
        if (nearer) {
            bool first = simplex.count == 0u;
            vec3 corner = minkowski_support(a, b, d, way, hulls);
            nearer = first || squared - dot3(way, corner) > NEAREST_PROGRESS * squared;
            if (nearer) {
                Simplex next = with_corner(simplex, corner);
                nearer = first || dot3(next.nearest, next.nearest) < squared;
                if (nearer) simplex = next;
            }
        }
    }
    return simplex;
}

LAWS_END

#endif
