// Separations of two boxes along the fifteen axes of SAT (Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996).
#ifndef SCREE_PHYSICS_BOX_SEPARATION_H
#define SCREE_PHYSICS_BOX_SEPARATION_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/collide/contact_margin.h"

LAWS_BEGIN

// A box in another one's frame: its axes x, y, z and its centre d (m).
struct BoxView {
    vec3 x;
    vec3 y;
    vec3 z;
    vec3 d;
};

LAW BoxView view_of(Pose from, Pose to) {
    Axes axes = axes_of(compose(conjugate(from.orientation), to.orientation));
    BoxView view;
    view.x = axes.x;
    view.y = axes.y;
    view.z = axes.z;
    view.d = rotate_back(from.orientation, to.position - from.position);
    return view;
}
// The first box in the frame of the second.
LAW BoxView reversed(BoxView view) {
    BoxView back = view;
    back.x = vec3(view.x.x, view.y.x, view.z.x);
    back.y = vec3(view.x.y, view.y.y, view.z.y);
    back.z = vec3(view.x.z, view.y.z, view.z.z);
    back.d = -vec3(dot3(view.d, view.x), dot3(view.d, view.y), dot3(view.d, view.z));
    return back;
}
// The coordinates, and the view with those of its frame or with the viewed box's axes, cyclically rotated by one.
LAW vec3 next(vec3 v) {
    return vec3(v.y, v.z, v.x);
}
LAW BoxView from_next(BoxView view) {
    view.x = next(view.x);
    view.y = next(view.y);
    view.z = next(view.z);
    view.d = next(view.d);
    return view;
}
LAW BoxView of_next(BoxView view) {
    vec3 x = view.x;
    view.x = view.y;
    view.y = view.z;
    view.z = x;
    return view;
}

// Separations (m) along the face normals of the box whose frame it is.
LAW vec3 face_separations(BoxView view, vec3 own, vec3 other) {
    vec3 reach = absolute3(view.x) * other.x + absolute3(view.y) * other.y + absolute3(view.z) * other.z;
    return absolute3(view.d) - own - reach;
}

// The best of the nine edge-edge axes: edge i of A and edge j of B; k = 3i + j.
struct EdgeAxis {
    float separation;  // m
    uint k;
};

// Edges closer to parallel than 0.005 rad are skipped; face normals are as good there.
LAW EdgeAxis best_edge_axis(BoxView view, vec3 own, vec3 other) {
    EdgeAxis best;
    best.separation = -1.0e30f;
    best.k = 0u;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            // Axis: (1, 0, 0) x view.x.
            float squared = view.x.y * view.x.y + view.x.z * view.x.z;
            bool crosses = squared > 2.5e-5f;
            if (!none(crosses)) {
                float own_reach = own.y * abs(view.x.z) + own.z * abs(view.x.y);
                float other_reach = other.y * abs(view.z.x) + other.z * abs(view.y.x);
                float along = abs(view.d.z * view.x.y - view.d.y * view.x.z);
                float separation = (along - (own_reach + other_reach)) * inverse_square_root(squared);
                bool is_better = crosses && separation > best.separation;
                best.separation = choose(is_better, separation, best.separation);
                best.k = choose(is_better, uint(3 * i + j), best.k);
            }
            view = of_next(view);
            other = next(other);
        }
        view = from_next(view);
        own = next(own);
    }
    return best;
}

// What SAT finds of two boxes; edge axes are left out if no face separates them already.
struct BoxAxes {
    BoxView b_from_a;
    vec3 faces_a;  // separations along the face normals of A, m
    vec3 faces_b;
    EdgeAxis edge;
};
LAW float best_face(vec3 separations) {
    return larger(larger(separations.x, separations.y), separations.z);
}
LAW BoxAxes box_axes(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    BoxAxes axes;
    axes.b_from_a = view_of(pose_a, pose_b);
    axes.faces_a = face_separations(axes.b_from_a, a.size, b.size);
    axes.faces_b = face_separations(reversed(axes.b_from_a), b.size, a.size);
    axes.edge.separation = -1.0e30f;
    axes.edge.k = 0u;
    bool near = larger(best_face(axes.faces_a), best_face(axes.faces_b)) < margin;
    if (!none(near)) axes.edge = best_edge_axis(axes.b_from_a, a.size, b.size);
    return axes;
}
// Whether some axis separates the boxes by the margin or more.
LAW bool are_apart(BoxAxes axes, float margin) {
    return larger(best_face(axes.faces_a), best_face(axes.faces_b)) >= margin || axes.edge.separation >= margin;
}

struct BoxPair {
    BoxAxes axes;
    Margin margin;
    float pad0, pad1, pad2;  // lanes take records by four words
};

LAWS_END

#endif
