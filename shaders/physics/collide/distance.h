// Distance of two bodies and its axis, for conservative advancement: exact for round shapes, a lower bound for two
// boxes.
#ifndef SCREE_PHYSICS_DISTANCE_H
#define SCREE_PHYSICS_DISTANCE_H

#include "shaders/physics/collide/collide_box_box.h"
#include "shaders/physics/collide/collide_box_plane.h"
#include "shaders/physics/collide/collide_capsule_box.h"
#include "shaders/physics/collide/collide_capsule_capsule.h"
#include "shaders/physics/collide/collide_capsule_plane.h"
#include "shaders/physics/collide/collide_sphere_box.h"
#include "shaders/physics/collide/collide_sphere_capsule.h"
#include "shaders/physics/collide/collide_sphere_plane.h"
#include "shaders/physics/collide/collide_sphere_sphere.h"
#include "shaders/physics/collide/shape_data.h"
// Scenes without general convex shapes omit code that takes lavapipe a second to compile.
#ifndef WITHOUT_CONVEX
#include "shaders/physics/collide/collide_convex.h"
#include "shaders/physics/collide/triangle.h"
#endif

LAWS_BEGIN

struct DistanceBound {
    vec3 normal;     // unit, world, from A to B
    float distance;  // m, < 0: penetration
};

LAW vec3 axis_towards(vec4 orientation, uint k, float side) {
    Axes axes = axes_of(orientation);
    vec3 axis = k == 0u ? axes.x : (k == 1u ? axes.y : axes.z);
    return side < 0.0f ? -axis : axis;
}

// The largest of the fifteen SAT separations: a lower bound of the distance, not positive for overlapping boxes. Edges are
// left out if a face separates the boxes by `enough` (m).
LAW DistanceBound distance_of_boxes(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float enough) {
    BoxView view = view_of(pose_a, pose_b);
    BoxView back = reversed(view);
    vec3 faces_a = face_separations(view, a.size, b.size);
    vec3 faces_b = face_separations(back, b.size, a.size);
    uint face_a = largest_of(faces_a);
    uint face_b = largest_of(faces_b);
    DistanceBound gap;
    gap.distance = coordinate(faces_a, face_a);
    gap.normal = axis_towards(pose_a.orientation, face_a, coordinate(view.d, face_a));
    if (coordinate(faces_b, face_b) > gap.distance) {
        gap.distance = coordinate(faces_b, face_b);
        gap.normal = -axis_towards(pose_b.orientation, face_b, coordinate(back.d, face_b));
    }
    if (gap.distance >= enough) return gap;
    EdgeAxis edge = best_edge_axis(view, a.size, b.size);
    if (edge.separation > gap.distance) {
        gap.distance = edge.separation;
        uint i = edge.k >= 6u ? 2u : (edge.k >= 3u ? 1u : 0u);
        vec3 along_a = axis_towards(pose_a.orientation, i, 1.0f);
        vec3 across = cross3(along_a, axis_towards(pose_b.orientation, edge.k - 3u * i, 1.0f));
        across = unit3(across, tangent(along_a));
        gap.normal = dot3(across, pose_b.position - pose_a.position) < 0.0f ? -across : across;
    }
    return gap;
}

LAW DistanceBound distance_of_manifold(ManifoldBuffer touch) {
    DistanceBound gap;
    gap.normal = touch.manifold.normal;
    gap.distance = deepest_of(touch);
    return gap;
}

#ifndef WITHOUT_CONVEX
// Of a general convex shape or triangle (second) and any other shape. Behind a triangle the distance is infinite.
LAW DistanceBound distance_of_convex(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float enough, Hulls hulls) {
    DistanceBound gap;
    ConvexShape of_b = convex_shape_of(b, pose_b.orientation, hulls);
    vec3 d = pose_b.position - pose_a.position;
    if (a.shape == SHAPE_PLANE) {
        gap.normal = a.size;
        gap.distance = dot3(a.size, d + support_of(of_b, -a.size, hulls));
        return gap;
    }
    ConvexShape of_a = convex_shape_of(a, pose_a.orientation, hulls);
    if (b.shape == SHAPE_TRIANGLE) {
        vec4 plane = plane_of(of_b, 0u, hulls);
        vec3 face = vec3(plane.x, plane.y, plane.z);
        if (!in_front(-dot3(face, d) - plane.w, of_a.scale)) {
            gap.normal = -face;
            gap.distance = 1.0e30f;
            return gap;
        }
    }
    Separation s = separation_of(of_a, of_b, d, enough, hulls);
    gap.normal = s.normal;
    gap.distance = s.distance;
    return gap;
}
#endif

// For the shape of the lower id first, as collision functions expect.
LAW DistanceBound distance_in_order(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float enough, Hulls hulls) {
#ifndef WITHOUT_CONVEX
    if (is_general_convex(b.shape) || b.shape == SHAPE_TRIANGLE) return distance_of_convex(a, pose_a, b, pose_b, enough, hulls);
#endif
    float any = 1.0e30f;
    if (a.shape == SHAPE_SPHERE) {
        if (b.shape == SHAPE_SPHERE) return distance_of_manifold(collide_sphere_sphere(a, pose_a, b, pose_b, any));
        if (b.shape == SHAPE_CAPSULE) return distance_of_manifold(collide_sphere_capsule(a, pose_a, b, pose_b, any));
        if (b.shape == SHAPE_BOX) return distance_of_manifold(collide_sphere_box(a, pose_a, b, pose_b, any));
        return distance_of_manifold(collide_sphere_plane(a, pose_a, b, pose_b, any));
    }
    if (a.shape == SHAPE_CAPSULE) {
        if (b.shape == SHAPE_CAPSULE) return distance_of_manifold(collide_capsule_capsule(a, pose_a, b, pose_b, any));
        if (b.shape == SHAPE_BOX) return distance_of_manifold(collide_capsule_box(a, pose_a, b, pose_b, any));
        return distance_of_manifold(collide_capsule_plane(a, pose_a, b, pose_b, any));
    }
    if (b.shape == SHAPE_BOX) return distance_of_boxes(a, pose_a, b, pose_b, enough);
    return distance_of_manifold(collide_box_plane(a, pose_a, b, pose_b, any));
}
// A separation of `enough` (m) along any axis suffices; the true distance may be larger.
LAW DistanceBound distance_between_shapes(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float enough,
                                          Hulls hulls) {
    bool swap = a.shape > b.shape;
    BodyProperties first = a, second = b;
    Pose first_pose = pose_a, second_pose = pose_b;
    if (swap) {
        first = b;
        second = a;
        first_pose = pose_b;
        second_pose = pose_a;
    }
    DistanceBound gap = distance_in_order(first, first_pose, second, second_pose, enough, hulls);
    if (swap) gap.normal = -gap.normal;
    return gap;
}

LAWS_END

#endif
