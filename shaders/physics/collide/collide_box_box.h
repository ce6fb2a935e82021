// Contact manifold of two boxes: SAT (box_separation.h), then face clipping or an edge pair.
#ifndef SCREE_PHYSICS_COLLIDE_BOX_BOX_H
#define SCREE_PHYSICS_COLLIDE_BOX_BOX_H

#include "shaders/physics/collide/box_faces.h"

LAWS_BEGIN

// Edge i of A of the edge axis k = 3i + j.
LAW uint edge_of_a(uint k) {
    return choose(k >= 6u, 2u, choose(k >= 3u, 1u, 0u));
}

// Edge contact: one point between the nearest points of the edges. If the edges of disjoint boxes end before they
// cross, the normal is the vector between their ends: along the axis they would seem nearer than they are.
LAW ManifoldBuffer manifold_of_edges(Pose pose_a, BoxView view, vec3 own, vec3 other, EdgeAxis axis, float margin) {
    uint i = edge_of_a(axis.k), j = axis.k - 3u * i;
    view = of_turned(from_turned(view, i), j);
    own = turned(own, i);
    other = turned(other, j);
    float squared = view.x.y * view.x.y + view.x.z * view.x.z;
    float scale = inverse_square_root(squared);
    scale = choose(view.d.z * view.x.y - view.d.y * view.x.z < 0.0f, -scale, scale);
    vec3 normal = vec3(0.0f, -view.x.z * scale, view.x.y * scale);

    // The two edges from A's centre: middles, and directions (1, 0, 0) and view.x.
    vec3 on_a = vec3(0.0f, choose(normal.y < 0.0f, -own.y, own.y), choose(normal.z < 0.0f, -own.z, own.z));
    vec3 on_b = view.d + view.y * choose(dot3(normal, view.y) < 0.0f, other.y, -other.y) +
                view.z * choose(dot3(normal, view.z) < 0.0f, other.z, -other.z);
    vec3 middle_b = on_b;
    vec3 r = on_b - on_a;
    float t = -(view.x.y * r.y + view.x.z * r.z) * (scale * scale);
    on_b = middle_b + view.x * clamped(t, -other.x, other.x);
    float s = on_b.x;
    on_a.x = clamped(s, -own.x, own.x);
    bool beyond_a = abs(s) > own.x, beyond_b = abs(t) > other.x;
    vec3 nearest_b = middle_b + view.x * clamped(dot3(view.x, on_a - middle_b), -other.x, other.x);
    on_b = choose(beyond_a, nearest_b, on_b);
    float separation = axis.separation;
    bool between_ends = (beyond_a || beyond_b) && separation > 0.0f;
    r = on_b - on_a;
    separation = choose(between_ends, length3(r), separation);
    normal = choose(between_ends, unit3(r, normal), normal);

    vec3 world_normal = rotate(pose_a.orientation, turned_back(normal, i));
    vec3 point = rotate(pose_a.orientation, turned_back((on_a + on_b) * 0.5f, i));
    return with_point(manifold_along(world_normal), point, separation, 64u + axis.k, margin);
}

// Edge axis k in the frame of A, towards B.
LAW vec3 edge_axis_of(BoxView view, uint k) {
    uint i = edge_of_a(k);
    BoxView turn = of_turned(from_turned(view, i), k - 3u * i);
    vec3 axis = unit3(vec3(0.0f, -turn.x.z, turn.x.y), vec3(0.0f, 1.0f, 0.0f));
    return turned_back(choose(dot3(axis, turn.d) < 0.0f, -axis, axis), i);
}

// Of two boxes that are not apart.
LAW ManifoldBuffer manifold_of_boxes(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, BoxAxes axes, float margin) {
    ReferenceFace reference = reference_face(axes, a.size, b.size);
    bool is_edge = is_edge_contact(axes, reference);
    vec3 axis = vec3(0.0f);
    bool aligned = false;
    if (!none(is_edge)) {
        axis = edge_axis_of(axes.b_from_a, axes.edge.k);
        BoxView view = of_turned(axes.b_from_a, reference.face);
        float cosine = choose(reference.of_b != 0u, dot3(axis, view.x), coordinate(axis, reference.face));
        aligned = is_edge && is_aligned(cosine);
    }
    ManifoldBuffer touch = empty_manifold(), along = empty_manifold();
    bool by_face = !is_edge || aligned;
    if (!none(by_face)) touch = choose(by_face, manifold_by_face(a, pose_a, b, pose_b, axes, reference, margin), touch);
    bool found = false;
    if (!none(aligned)) {
        vec3 world_axis = rotate(pose_a.orientation, axis);
        along = choose(aligned, along_axis(touch, world_axis, axes.edge.separation, margin), along);
        found = aligned && is_patch_as_deep(along, axes.edge.separation, PATCH_SHORTFALL * reference.slop);
        touch = choose(found, along, touch);
    }
    bool tries_edges = !found && (is_edge || falls_short(touch, axes, reference));
    if (!none(tries_edges)) {
        ManifoldBuffer by_edges = manifold_of_edges(pose_a, axes.b_from_a, a.size, b.size, axes.edge, margin);
        bool takes = tries_edges && by_edges.count > 0u;
        // Ends of edges that are apart have a normal of their own.
        bool of_axis = takes && is_aligned(dot3(by_edges.manifold.normal, along.manifold.normal));
        touch = choose(takes, by_edges, touch);
        if (!none(of_axis)) touch = choose(of_axis, with_patch(by_edges, along, margin), touch);
    }
    return touch;
}

LAW ManifoldBuffer collide_box_box(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    BoxAxes axes = box_axes(a, pose_a, b, pose_b, margin);
    bool touches = !are_apart(axes, margin);
    if (none(touches)) return empty_manifold();
    return choose(touches, manifold_of_boxes(a, pose_a, b, pose_b, axes, margin), empty_manifold());
}

LAWS_END

#endif
