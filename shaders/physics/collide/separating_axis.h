// Axis of greatest separation, or of least penetration, of two convex bodies.
//
// The separation along an axis never exceeds the distance; its maximum over all axes is the distance, or minus the
// penetration depth if the bodies overlap. Face normals are tried first. From the best one, the search pushes the
// bodies apart along the axis until there is a small gap, and takes GJK's vector between them as the next axis: the
// separation grows in each round, and a fixed point is a local maximum (a proximal point method, Rockafellar, SIAM J.
// Control and Optimization 14, 1976). So discs, cones and polyhedra need only their support functions, and edges need
// no list. For polyhedra one test proves an axis final: the other's support lies over the face, or the origin over the
// simplex triangle.
#ifndef SCREE_PHYSICS_SEPARATING_AXIS_H
#define SCREE_PHYSICS_SEPARATING_AXIS_H

#include "shaders/physics/collide/gjk.h"

LAWS_BEGIN

// Rounds of pushing apart. With one, an edge axis found from a face is off by degrees for overlapping bodies.
CONSTANT uint PUSH_ROUNDS = 3u;
// The gap after pushing apart, relative to the smaller min_half_width. With less, rounding turns the vector; with more,
// the rounds converge slowly.
CONSTANT float PUSH_ROOM = 0.1f;

struct Separation {
    vec3 normal;     // unit, from A to B
    float distance;  // m, between the surfaces
    uint face_a;     // best reference faces of A and B
    uint face_b;
    float by_face_a;  // its separation, m; -1e30 without faces
    float by_face_b;  // -1e30 also where it is no more than A's
    bool over_face;   // the other body's support lies over the better face
};

// Planes of hulls are evaluated in the hull's frame, those of others in world axes: the plane of a face, a vector in
// the same frame, and the height of a point over the plane.
LAW vec4 plane_as_listed(ConvexShape own, uint face, Hulls hulls) {
    if (own.shape == SHAPE_HULL) return hull_plane(hulls, own.hull, own.head, face);
    return plane_of(own, face, hulls);
}
LAW vec3 as_listed(ConvexShape own, vec3 v) {
    return own.shape == SHAPE_HULL ? in_body(own.axes, v) : v;
}
LAW float height_over(vec4 plane, vec3 point) {
    return dot3(vec3(plane.x, plane.y, plane.z), point) - plane.w;
}
// The face over which the point is highest.
LAW uint highest_over(ConvexShape own, Faces faces, vec3 point, Hulls hulls) {
    uint found = 0u;
    float best = -1.0e30f;
    for (uint k = 0u; k < faces.count; ++k) {
        uint face = face_at(faces, k);
        float height = height_over(plane_as_listed(own, face, hulls), point);
        if (height > best) {
            best = height;
            found = face;
        }
    }
    return found;
}

// Whether a point (from the body's centre) projects into a face: then no axis near that face's normal separates more.
LAW bool lies_over(ConvexShape own, uint face, vec3 point, Hulls hulls) {
    vec4 plane = plane_of(own, face, hulls);
    vec3 normal = vec3(plane.x, plane.y, plane.z);
    if (own.shape == SHAPE_CYLINDER || own.shape == SHAPE_CONE) {
        vec3 across = point - normal * dot3(normal, point);
        return dot3(across, across) < own.size.x * own.size.x;
    }
    Feature sides = face_as_feature(own, face, normal, hulls);
    if (sides.stride > 1u) return false;
    vec3 from = corner_of(own, sides, sides.points - 1u, hulls);
    bool over = true;
    for (uint k = 0u; k < sides.points && over; ++k) {
        vec3 to = corner_of(own, sides, k, hulls);
        over = dot3(cross3(to - from, point - from), normal) >= 0.0f;
        from = to;
    }
    return over;
}
// The same for a triangle of the Minkowski difference.
LAW bool lies_over_triangle(Simplex s, vec3 point) {
    if (s.count != 3u) return false;
    vec3 normal = cross3(s.b - s.a, s.c - s.a);
    float first = dot3(cross3(s.b - s.a, point - s.a), normal);
    float second = dot3(cross3(s.c - s.b, point - s.b), normal);
    float third = dot3(cross3(s.a - s.c, point - s.c), normal);
    return first > 0.0f && second > 0.0f && third > 0.0f;
}

// The functions below treat both bodies in one loop instead of twice: every call of a support function is another
// inlined copy on a device, and drivers took minutes to compile a dozen.
//
// Loops over faces and in GJK exit at their head only: where threads left a loop in the middle of a round, lavapipe has
// been seen to give them values of rounds that other threads went on with.
//
// A face's support is evaluated only if the face may be the best: first the face over which the other's centre is
// highest; then faces over which that centre, less the other's inner radius, and the deepest vertex of the best face so
// far are high enough. Of equals the first counts. B's faces are skipped unless they may beat A's, and the search ends
// once the bodies are known to be `enough` (m) apart.
LAW Separation separation_by_faces(ConvexShape a, ConvexShape b, vec3 d, float enough, Hulls hulls) {
    Separation s;
    s.normal = unit3(d, a.axes.y);
    s.distance = -1.0e30f;
    s.face_a = 0u;
    s.face_b = 0u;
    s.by_face_a = -1.0e30f;
    s.by_face_b = -1.0e30f;
    s.over_face = false;
    vec3 over_best = d;
    for (uint side = 0u; side < 2u; ++side) {
        ConvexShape own = a;
        ConvexShape other = b;
        vec3 between = d;
        if (side == 1u) {
            own = b;
            other = a;
            between = -d;
        }
        if (own.head.faces == 0u || s.distance >= enough) continue;
        vec3 middle = as_listed(own, between), lowest = middle;
        Faces faces = faces_towards(own, middle, hulls);
        uint first = highest_over(own, faces, middle, hulls);
        uint best_face = first;
        float best = s.distance;
        vec3 over = between, axis = between;
        uint face = first, next = 0u;
        bool better = false;
        bool more = height_over(plane_as_listed(own, face, hulls), middle) - other.head.inner >= best, left = true;
        while (left) {
            if (more) {
                vec4 plane = plane_of(own, face, hulls);
                vec3 normal = vec3(plane.x, plane.y, plane.z);
                vec3 corner = between + support_of(other, -normal, hulls);
                float separation = dot3(normal, corner) - plane.w;
                if (separation > best || (better && separation == best && face < best_face)) {
                    better = true;
                    best = separation;
                    best_face = face;
                    over = corner;
                    axis = normal;
                    lowest = as_listed(own, corner);
                }
            }
            more = false;
            left = best < enough;
            while (left && !more) {
                if (next < faces.count) {
                    face = face_at(faces, next);
                    vec4 listed = plane_as_listed(own, face, hulls);
                    more = face != first && height_over(listed, middle) - other.head.inner >= best &&
                           (!better || height_over(listed, lowest) >= best);
                    ++next;
                } else {
                    // Unlisted faces only if they could be better than all listed ones.
                    left = !faces.all && (length3(between) * faces.beyond - own.head.inner) - other.head.inner >= best;
                    if (left) {
                        faces = all_faces(own);
                        next = 0u;
                    }
                }
            }
        }
        if (better) {
            s.distance = best;
            s.normal = side == 0u ? axis : -axis;
            over_best = over;
        }
        if (side == 0u) {
            s.face_a = best_face;
            s.by_face_a = best;
        } else {
            s.face_b = best_face;
            s.by_face_b = better ? best : -1.0e30f;
        }
    }
    if (s.by_face_a > -1.0e30f || s.by_face_b > -1.0e30f) {
        ConvexShape own = a;
        if (s.by_face_b > s.by_face_a) own = b;
        s.over_face = lies_over(own, s.by_face_b > s.by_face_a ? s.face_b : s.face_a, over_best, hulls);
    }
    return s;
}

// Side normals tried after the faces; then axes by pushing apart.
CONSTANT uint SIDE_AXES = 3u;
LAW vec3 side_axis_between(ConvexShape a, ConvexShape b, vec3 d, uint k) {
    if (k == 0u) return side_normal(a.shape, a.size, a.axes, d);
    if (k == 1u) return -side_normal(b.shape, b.size, b.axes, -d);
    vec3 across = unit3(cross3(a.axes.y, b.axes.y), a.axes.x);
    return dot3(across, d) < 0.0f ? -across : across;
}

// Ends early once the bodies are known to be `enough` (m) apart.
LAW Separation separation_of(ConvexShape a, ConvexShape b, vec3 d, float enough, Hulls hulls) {
    float radii = a.radius + b.radius;
    Separation s = separation_by_faces(a, b, d, enough + radii, hulls);
    float room = PUSH_ROOM * smaller(a.scale, b.scale);
    bool known = s.over_face, converged = false, curved = is_smooth(a.shape) || is_smooth(b.shape);
    for (uint k = has_side(a.shape) || has_side(b.shape) ? 0u : SIDE_AXES; k < SIDE_AXES + PUSH_ROUNDS; ++k) {
        if (converged || s.distance - radii >= enough || (known && k >= SIDE_AXES)) break;
        bool apart = s.distance >= room;
        vec3 normal = s.normal;
        if (k < SIDE_AXES) {
            if ((k != 1u && !has_side(a.shape)) || (k != 0u && !has_side(b.shape))) continue;
            normal = side_axis_between(a, b, d, k);
        } else {
            vec3 push = apart ? vec3(0.0f) : s.normal * (room - s.distance);
            Simplex nearest = gjk_closest(a, b, d + push, s.normal, hulls);
            normal = unit3(nearest.nearest, s.normal);
            known = !curved && lies_over_triangle(nearest, push);
        }
        float distance = dot3(normal, minkowski_support(a, b, d, normal, hulls));
        float gain = distance - s.distance;
        if (gain > 0.0f) {
            s.distance = distance;
            s.normal = normal;
            if (k < SIDE_AXES) known = false;
        }
        converged = k >= SIDE_AXES && ((apart && !curved) || gain < 1.0e-5f * room);
    }
    s.distance = s.distance - radii;
    s.by_face_a = s.by_face_a - radii;
    s.by_face_b = s.by_face_b - radii;
    return s;
}

LAWS_END

#endif
