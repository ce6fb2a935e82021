// Along which axis two convex bodies are farthest apart, or overlap least.
//
// The separation along an axis is never more than the distance, and over all axes the largest is the distance, or where the two
// overlap the least way that parts them, as a negative number. The axes of their faces are tried first. From the best of these
// the others are found by pushing the bodies apart along the axis until there is a little room, and taking the shortest way
// between them for the next axis: the separation grows with each round, and what no longer changes is a largest one (in the words
// of optimisation a proximal point method, Rockafellar, SIAM J. Control and Optimization 14, 1976). So discs, cones and polyhedra
// need nothing but their supports, and edges need no list. Of an axis of polyhedra one look tells that it will not change: what
// the bodies push against each other with lies over the face, or the origin over the triangle of their difference.
#ifndef SCREE_PHYSICS_SEPARATING_AXIS_H
#define SCREE_PHYSICS_SEPARATING_AXIS_H

#include "shaders/physics/collide/gjk.h"

LAWS_BEGIN

// Rounds of pushing apart. With one, an edge found from a face is off by degrees where bodies overlap.
CONSTANT uint PUSH_ROUNDS = 3u;
// Of the thinner body's half width: the room between the bodies when they are pushed apart. Less, and rounding turns the way
// between them; more, and the rounds converge slowly.
CONSTANT float PUSH_ROOM = 0.1f;

struct Separation {
    vec3 normal;     // unit, from A to B
    float distance;  // m, between the surfaces
    uint face_a;     // the best face of A, of B
    uint face_b;
    float by_face_a;  // its separation, m; -1e30 without faces
    float by_face_b;  // -1e30 also where it is no more than A's
    bool over_face;   // the better of the two faces has what reaches farthest towards it over itself
};

// A hull's planes are looked at in its own frame, others' in the world's: the plane of a face, a vector to go with it, and how
// high a point lies over it.
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
// Of some faces that over which the point lies highest.
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

// Whether a point, seen from the body's centre, lies over a face: then nothing near that face's axis parts the bodies farther.
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
// The same of a triangle of points of the difference of the two bodies.
LAW bool lies_over_triangle(Simplex s, vec3 point) {
    if (s.count != 3u) return false;
    vec3 normal = cross3(s.b - s.a, s.c - s.a);
    float first = dot3(cross3(s.b - s.a, point - s.a), normal);
    float second = dot3(cross3(s.c - s.b, point - s.b), normal);
    float third = dot3(cross3(s.a - s.c, point - s.c), normal);
    return first > 0.0f && second > 0.0f && third > 0.0f;
}

// The laws below look at both bodies in one loop instead of twice in a row: every support that is asked for in another place is
// another copy of its code on a device, and drivers took minutes to compile a dozen of them.
//
// And the loops of faces and of the way between are left at their head alone: where some threads left one in the middle of a
// round, lavapipe has been seen to give them values of the rounds that the others went on with.
//
// A face's support is asked for only if the face may be the best one: of each body first that over which the other's centre lies
// highest; then those over which that centre lies high enough, seeing how far the other reaches in any direction, and no lower
// the corner that is lowest over the best face so far. Of equals the first counts. The second body's are only looked at so far
// as they may be better than the first's best, and no more is asked once the two are known to be `enough` (m) apart.
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
                    // What the cell does not list counts only where it could be better than all that it does.
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

// The axis to try next after the faces: of the first three, what the sides say; then the way between bodies pushed apart.
CONSTANT uint SIDE_AXES = 3u;
LAW vec3 side_axis_between(ConvexShape a, ConvexShape b, vec3 d, uint k) {
    if (k == 0u) return side_normal(a.shape, a.size, a.axes, d);
    if (k == 1u) return -side_normal(b.shape, b.size, b.axes, -d);
    vec3 across = unit3(cross3(a.axes.y, b.axes.y), a.axes.x);
    return dot3(across, d) < 0.0f ? -across : across;
}

// Stops early where the two are known to be `enough` apart.
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
            vec3 push = apart ? d - d : s.normal * (room - s.distance);
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
