// Contact manifold of two boxes: SAT (box_separation.h), then face clipping or an edge pair.
#ifndef SCREE_PHYSICS_COLLIDE_BOX_BOX_H
#define SCREE_PHYSICS_COLLIDE_BOX_BOX_H

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
    vec3 x = k == 0u ? view.x : (k == 1u ? view.y : view.z);
    vec3 y = k == 0u ? view.y : (k == 1u ? view.z : view.x);
    vec3 z = k == 0u ? view.z : (k == 1u ? view.x : view.y);
    view.x = x;
    view.y = y;
    view.z = z;
    return view;
}

// Edge contact: one point between the nearest points of the edges. If the edges of disjoint boxes end before they
// cross, the normal is the vector between their ends: along the axis they would seem nearer than they are.
LAW ManifoldBuffer manifold_of_edges(Pose pose_a, BoxView view, vec3 own, vec3 other, EdgeAxis axis, float margin) {
    uint i = axis.k >= 6u ? 2u : (axis.k >= 3u ? 1u : 0u);
    uint j = axis.k - 3u * i;
    view = of_turned(from_turned(view, i), j);
    own = turned(own, i);
    other = turned(other, j);
    float squared = view.x.y * view.x.y + view.x.z * view.x.z;
    float scale = inverse_square_root(squared);
    if (view.d.z * view.x.y - view.d.y * view.x.z < 0.0f) scale = -scale;
    vec3 normal = vec3(0.0f, -view.x.z * scale, view.x.y * scale);

    // The two edges from A's centre: middles, and directions (1, 0, 0) and view.x.
    vec3 on_a = vec3(0.0f, normal.y < 0.0f ? -own.y : own.y, normal.z < 0.0f ? -own.z : own.z);
    vec3 on_b = view.d + view.y * (dot3(normal, view.y) < 0.0f ? other.y : -other.y) +
                view.z * (dot3(normal, view.z) < 0.0f ? other.z : -other.z);
    vec3 middle_b = on_b;
    vec3 r = on_b - on_a;
    float t = -(view.x.y * r.y + view.x.z * r.z) * (scale * scale);
    on_b = middle_b + view.x * clamped(t, -other.x, other.x);
    bool beyond = abs(t) > other.x;
    float s = on_b.x;
    on_a.x = clamped(s, -own.x, own.x);
    if (abs(s) > own.x) {
        beyond = true;
        on_b = middle_b + view.x * clamped(dot3(view.x, on_a - middle_b), -other.x, other.x);
    }
    float separation = axis.separation;
    if (beyond && separation > 0.0f) {
        r = on_b - on_a;
        separation = length3(r);
        normal = unit3(r, normal);
    }

    vec3 world_normal = rotate(pose_a.orientation, turned_back(normal, i));
    vec3 point = rotate(pose_a.orientation, turned_back((on_a + on_b) * 0.5f, i));
    return with_point(manifold_along(world_normal), point, separation, 64u + axis.k, margin);
}

// Face contact: reference face `face` of the box at `pose` against the incident face of the other. Points from the
// reference's centre; the normal points away from it; features as of overlay_corner(). If the clipped patch is empty
// but the contact `must_hold`, the reference face's point nearest to the deepest corner replaces it.
LAW ManifoldBuffer manifold_of_faces(Pose pose, BoxView view, vec3 own, vec3 other, uint face, float slop, float margin,
                                     bool must_hold) {
    view = from_turned(view, face);
    own = turned(own, face);
    float outward = view.d.x < 0.0f ? -1.0f : 1.0f;
    uint incident = largest_of(vec3(abs(view.x.x), abs(view.y.x), abs(view.z.x)));
    view = of_turned(view, incident);
    other = turned(other, incident);
    vec3 centre = view.d + view.x * (view.x.x * outward > 0.0f ? -other.x : other.x);
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

    ManifoldBuffer touch = manifold_along(rotate(pose.orientation, turned_back(vec3(outward, 0.0f, 0.0f), face)));
    for (uint k = 0u; k < CLIP_CANDIDATES; ++k) {
        bool stands_in = k == 0u && chosen == 0u && must_hold;
        if (stands_in || (chosen & (1u << k)) != 0u) {
            vec4 corner = clip_corner(corners, k);
            if (stands_in) {
                vec3 lowest = centre + e * (e.x < 0.0f ? 1.0f : -1.0f) + f * (f.x < 0.0f ? 1.0f : -1.0f);
                corner = vec4(lowest.x, clamped(lowest.y, -own.y, own.y), clamped(lowest.z, -own.z, own.z), 31.0f);
            }
            vec3 point = vec3(outward * (own.x + 0.5f * corner.x), corner.y, corner.z);
            point = rotate(pose.orientation, turned_back(point, face));
            touch = with_point(touch, point, corner.x, uint(corner.w), margin);
        }
    }
    return touch;
}

// Edge axis k = 3i + j in the frame of A, towards B.
LAW vec3 edge_axis_of(BoxView view, uint k) {
    uint i = k >= 6u ? 2u : (k >= 3u ? 1u : 0u);
    BoxView turn = of_turned(from_turned(view, i), k - 3u * i);
    vec3 axis = unit3(vec3(0.0f, -turn.x.z, turn.x.y), vec3(0.0f, 1.0f, 0.0f));
    return turned_back(dot3(axis, turn.d) < 0.0f ? -axis : axis, i);
}

// Of two boxes that are not apart. Faces of A are preferred to those of B, and both to edges, so that resting contacts do not
// alternate.
LAW ManifoldBuffer manifold_of_boxes(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, BoxAxes axes, float margin) {
    BoxView b_from_a = axes.b_from_a;
    float slop = smaller(slop_of(a.size), slop_of(b.size));
    uint face_a = largest_of(axes.faces_a);
    uint face_b = largest_of(axes.faces_b);
    float best_a = coordinate(axes.faces_a, face_a);
    float best_b = coordinate(axes.faces_b, face_b);
    bool of_b = best_b > best_a + 0.1f * slop;
    float best_face = of_b ? best_b : best_a;
    bool edge_serves = axes.edge.separation > best_face - slop;
    bool is_edge = axes.edge.separation > best_face + slop;
    vec3 axis = vec3(0.0f);
    bool aligned = false;
    if (is_edge) {
        axis = edge_axis_of(b_from_a, axes.edge.k);
        vec3 normal_b = face_b == 0u ? b_from_a.x : (face_b == 1u ? b_from_a.y : b_from_a.z);
        aligned = is_aligned(of_b ? dot3(axis, normal_b) : coordinate(axis, face_a));
    }
    ManifoldBuffer touch = empty_manifold();
    if (!is_edge || aligned) {
        Pose reference = pose_a;
        BoxView view = b_from_a;
        vec3 own = a.size;
        vec3 other = b.size;
        uint face = face_a;
        if (of_b) {
            reference = pose_b;
            view = reversed(b_from_a);
            own = b.size;
            other = a.size;
            face = face_b;
        }
        touch = manifold_of_faces(reference, view, own, other, face, slop, margin, best_face < 0.0f && !edge_serves);
        if (of_b) touch = flipped(touch, pose_a.position - pose_b.position);
    }
    ManifoldBuffer along = empty_manifold();
    if (aligned) {
        along = along_axis(touch, rotate(pose_a.orientation, axis), axes.edge.separation, margin);
        if (is_patch_as_deep(along, axes.edge.separation, PATCH_SHORTFALL * slop)) return along;
    }
    // If the clipped patch is not as deep as the face planes say, use an edge axis that is no worse.
    if (is_edge || (edge_serves && deepest_of(touch) > best_face + slop)) {
        ManifoldBuffer by_edges = manifold_of_edges(pose_a, b_from_a, a.size, b.size, axes.edge, margin);
        // Ends of edges that are apart have a normal of their own.
        bool of_axis = is_aligned(dot3(by_edges.manifold.normal, along.manifold.normal));
        if (by_edges.count > 0u) touch = of_axis ? with_patch(by_edges, along, margin) : by_edges;
    }
    return touch;
}

LAW ManifoldBuffer collide_box_box(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    BoxAxes axes = box_axes(a, pose_a, b, pose_b, margin);
    if (are_apart(axes, margin)) return empty_manifold();
    return manifold_of_boxes(a, pose_a, b, pose_b, axes, margin);
}

LAWS_END

#endif
