// Face contact of two boxes: the reference face, and the incident face clipped by its sides.
#ifndef SCREE_PHYSICS_BOX_FACES_H
#define SCREE_PHYSICS_BOX_FACES_H

#include "shaders/physics/collide/box_axes.h"
#include "shaders/physics/collide/box_separation.h"
#include "shaders/physics/collide/manifold.h"
#include "shaders/physics/collide/manifold_reduction.h"

LAWS_BEGIN

// The view with the frame's coordinates rotated cyclically.
LAW BoxView from_turned(BoxView view, uint k) {
    view.x = turned(view.x, k);
    view.y = turned(view.y, k);
    view.z = turned(view.z, k);
    view.d = turned(view.d, k);
    return view;
}
// The view with the viewed box's axes rotated cyclically.
LAW BoxView of_turned(BoxView view, uint k) {
    vec3 x = choose(k == 0u, view.x, choose(k == 1u, view.y, view.z));
    vec3 y = choose(k == 0u, view.y, choose(k == 1u, view.z, view.x));
    vec3 z = choose(k == 0u, view.z, choose(k == 1u, view.x, view.y));
    view.x = x;
    view.y = y;
    view.z = z;
    return view;
}

// The reference face of two boxes, the one of greatest separation. Faces of A are preferred to those of B, and both to edges, so
// that resting contacts do not alternate.
struct ReferenceFace {
    float separation;  // m
    float slop;        // slop_of the smaller box, m
    uint face;         // along x, y or z
    uint of_b;         // 1: a face of B
};
LAW ReferenceFace reference_face(BoxAxes axes, vec3 size_a, vec3 size_b) {
    uint face_a = largest_of(axes.faces_a), face_b = largest_of(axes.faces_b);
    float best_a = coordinate(axes.faces_a, face_a), best_b = coordinate(axes.faces_b, face_b);
    ReferenceFace reference;
    reference.slop = smaller(slop_of(size_a), slop_of(size_b));
    bool of_b = best_b > best_a + 0.1f * reference.slop;
    reference.separation = choose(of_b, best_b, best_a);
    reference.face = choose(of_b, face_b, face_a);
    reference.of_b = choose(of_b, 1u, 0u);
    return reference;
}
// Whether an edge axis separates the boxes more than the face does; whether it may stand in for a patch that falls short.
LAW bool is_edge_contact(BoxAxes axes, ReferenceFace reference) {
    return axes.edge.separation > reference.separation + reference.slop;
}
LAW bool edge_may_serve(BoxAxes axes, ReferenceFace reference) {
    return axes.edge.separation > reference.separation - reference.slop;
}

// Face contact: reference face `face` of the box of that orientation against the incident face of the other. Points from the
// reference's centre; the normal points away from it; features as of overlay_corner(). If the clipped patch is empty
// but the contact `must_hold`, the reference face's point nearest to the deepest corner replaces it.
LAW ManifoldBuffer manifold_of_faces(vec4 orientation, BoxView view, vec3 own, vec3 other, uint face, float slop, float margin,
                                     bool must_hold) {
    view = from_turned(view, face);
    own = turned(own, face);
    float outward = choose(view.d.x < 0.0f, -1.0f, 1.0f);
    uint incident = largest_of(vec3(abs(view.x.x), abs(view.y.x), abs(view.z.x)));
    view = of_turned(view, incident);
    other = turned(other, incident);
    vec3 centre = view.d + view.x * choose(view.x.x * outward > 0.0f, -other.x, other.x);
    vec3 e = view.y * other.y;
    vec3 f = view.z * other.z;
    // Heights are measured from the reference face, outwards.
    centre.x = centre.x * outward - own.x;
    e.x = e.x * outward;
    f.x = f.x * outward;
    float flat_within = 0.1f * slop;
    Overlay overlay = overlay_of(centre, e, f, own.y, own.z, flat_within);
    ClipCorners corners = clip_corners_of(overlay);
    uint chosen = best_four(corners, margin, flat_within);

    ManifoldBuffer touch = manifold_along(rotate(orientation, turned_back(vec3(outward, 0.0f, 0.0f), face)));
    for (int k = 0; k < CLIP_CANDIDATES; ++k) {
        bool stands_in = k == 0 && must_hold && chosen == 0u;
        bool there = stands_in || (chosen & (1u << k)) != 0u;
        if (!none(there)) {
            vec4 corner = clip_corner(corners, k);
            if (!none(stands_in)) {
                vec3 lowest = centre + e * choose(e.x < 0.0f, 1.0f, -1.0f) + f * choose(f.x < 0.0f, 1.0f, -1.0f);
                vec4 nearest = vec4(lowest.x, clamped(lowest.y, -own.y, own.y), clamped(lowest.z, -own.z, own.z), 31.0f);
                corner = choose(stands_in, nearest, corner);
            }
            vec3 point = vec3(outward * (own.x + 0.5f * corner.x), corner.y, corner.z);
            point = rotate(orientation, turned_back(point, face));
            touch = with_point(there, touch, point, corner.x, uint(corner.w), margin);
        }
    }
    return touch;
}

// The contact of two boxes that are not apart by their reference face, as a manifold of (A, B).
LAW ManifoldBuffer manifold_by_face(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, BoxAxes axes,
                                    ReferenceFace reference, float margin) {
    bool of_b = reference.of_b != 0u;
    BoxView seen_a = axes.b_from_a, seen_b = reversed(axes.b_from_a), view = seen_a;
    view.x = choose(of_b, seen_b.x, seen_a.x);
    view.y = choose(of_b, seen_b.y, seen_a.y);
    view.z = choose(of_b, seen_b.z, seen_a.z);
    view.d = choose(of_b, seen_b.d, seen_a.d);
    bool must_hold = reference.separation < 0.0f && !edge_may_serve(axes, reference);
    ManifoldBuffer touch =
        manifold_of_faces(choose(of_b, pose_b.orientation, pose_a.orientation), view, choose(of_b, b.size, a.size),
                          choose(of_b, a.size, b.size), reference.face, reference.slop, margin, must_hold);
    return flipped(of_b, touch, pose_a.position - pose_b.position);
}
// Whether the clipped patch is not as deep as the face planes say, while an edge axis is no worse.
LAW bool falls_short(ManifoldBuffer by_face, BoxAxes axes, ReferenceFace reference) {
    return edge_may_serve(axes, reference) && deepest_of(by_face) > reference.separation + reference.slop;
}

LAWS_END

#endif
