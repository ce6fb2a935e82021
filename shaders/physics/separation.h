// Along which axis two convex bodies are farthest apart, or overlap least.
//
// The separation along an axis is never more than the distance, and over all axes the largest is the distance, or where the two
// overlap the least way that parts them, as a negative number. The axes of their faces are tried first. From the best of these
// the others are found by pushing the bodies apart along the axis until there is a little room, and taking the shortest way
// between them for the next axis: the separation grows with each round, and what no longer changes is a largest one (in the words
// of optimisation a proximal point method, Rockafellar, SIAM J. Control and Optimization 14, 1976). So discs, cones and polyhedra
// need nothing but their supports, and edges need no list.
#ifndef SCREE_PHYSICS_SEPARATION_H
#define SCREE_PHYSICS_SEPARATION_H

#include "shaders/physics/nearest.h"

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
    float by_face_b;
};

// Axes that belong to the side of a cylinder or a cone: straight towards the other one's middle.
LAW vec3 side_axis(Solid solid, vec3 towards) {
    vec3 outward = outward_from_axis(solid.axes, towards);
    return solid.shape == SHAPE_CONE ? cone_normal(solid.axes, solid.size, outward) : outward;
}
LAW bool has_side(Solid solid) {
    return solid.shape == SHAPE_CYLINDER || solid.shape == SHAPE_CONE || solid.shape == SHAPE_CAPSULE;
}

// The laws below look at both bodies in one loop instead of twice in a row: every support that is asked for in another place is
// another copy of its code on a device, and drivers took minutes to compile a dozen of them.
LAW Separation separation_by_faces(Solid a, Solid b, vec3 d, Hulls hulls) {
    Separation s;
    s.normal = unit3(d, a.axes.y);
    s.distance = -1.0e30f;
    s.face_a = 0u;
    s.face_b = 0u;
    s.by_face_a = -1.0e30f;
    s.by_face_b = -1.0e30f;
    uint faces_a = faces_of(a, hulls);
    uint faces = faces_a + faces_of(b, hulls);
    for (uint k = 0u; k < faces; ++k) {
        bool of_a = k < faces_a;
        Solid own = of_a ? a : b;
        Solid other = of_a ? b : a;
        vec3 between = of_a ? d : -d;
        uint face = of_a ? k : k - faces_a;
        vec4 plane = plane_of(own, face, hulls);
        vec3 normal = vec3(plane.x, plane.y, plane.z);
        float separation = dot3(normal, between + support_of(other, -normal, hulls)) - plane.w;
        if (separation > (of_a ? s.by_face_a : s.by_face_b)) {
            if (of_a) {
                s.by_face_a = separation;
                s.face_a = face;
            } else {
                s.by_face_b = separation;
                s.face_b = face;
            }
        }
        if (separation > s.distance) {
            s.distance = separation;
            s.normal = of_a ? normal : -normal;
        }
    }
    return s;
}

// The axis to try next after the faces: of the first three, what the sides say; then the way between bodies pushed apart.
CONSTANT uint SIDE_AXES = 3u;
LAW vec3 side_axis_between(Solid a, Solid b, vec3 d, uint k) {
    if (k == 0u) return side_axis(a, d);
    if (k == 1u) return -side_axis(b, -d);
    vec3 across = unit3(cross3(a.axes.y, b.axes.y), a.axes.x);
    return dot3(across, d) < 0.0f ? -across : across;
}

// Stops early where the two are known to be `enough` apart.
LAW Separation separation_of(Solid a, Solid b, vec3 d, float enough, Hulls hulls) {
    float radii = a.radius + b.radius;
    Separation s = separation_by_faces(a, b, d, hulls);
    float room = PUSH_ROOM * smaller(a.scale, b.scale);
    for (uint k = 0u; k < SIDE_AXES + PUSH_ROUNDS; ++k) {
        if (s.distance - radii >= enough) break;
        bool apart = s.distance >= room;
        vec3 normal = s.normal;
        if (k < SIDE_AXES) {
            if ((k != 1u && !has_side(a)) || (k != 0u && !has_side(b))) continue;
            normal = side_axis_between(a, b, d, k);
        } else {
            vec3 pushed = apart ? d : d + s.normal * (room - s.distance);
            normal = unit3(way_between(a, b, pushed, s.normal, hulls), s.normal);
        }
        float distance = dot3(normal, difference_along(a, b, d, normal, hulls));
        float gain = distance - s.distance;
        if (gain > 0.0f) {
            s.distance = distance;
            s.normal = normal;
        }
        if (k >= SIDE_AXES && (apart || gain < 1.0e-5f * room)) break;
    }
    s.distance = s.distance - radii;
    s.by_face_a = s.by_face_a - radii;
    s.by_face_b = s.by_face_b - radii;
    return s;
}

LAWS_END

#endif
