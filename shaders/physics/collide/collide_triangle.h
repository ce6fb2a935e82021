// Contact manifolds of spheres and other convex bodies with a mesh triangle, which is solid behind its face and stores
// its neighbours' normals.
#ifndef SCREE_PHYSICS_COLLIDE_TRIANGLE_H
#define SCREE_PHYSICS_COLLIDE_TRIANGLE_H

#include "shaders/physics/collide/collide_convex.h"
#include "shaders/physics/collide/triangle.h"

LAWS_BEGIN

// Where the edges refuse the axis of least penetration, the patch below the face may be deeper than that penetration by
// this part of min_half_width. With less, a body pressed into a seam has no contact; with more, a box that leans on a
// step is lifted onto it.
CONSTANT float UNDER_SEAM = 0.05f;

// The sphere first. By the point of the triangle nearest to the centre.
LAW ManifoldBuffer collide_sphere_triangle(BodyProperties ta, Pose pose_a, BodyProperties tb, Pose pose_b, float margin,
                                           Hulls hulls) {
    ConvexShape triangle = convex_shape_of(tb, pose_b.orientation, hulls);
    float radius = ta.size.x;
    vec3 centre = pose_a.position - pose_b.position;
    vec4 plane = plane_of(triangle, 0u, hulls);
    vec3 face = vec3(plane.x, plane.y, plane.z);
    float height = dot3(face, centre) - plane.w;
    if (!in_front(height, radius) || height - radius >= margin) return empty_manifold();
    Simplex nearest =
        nearest_on_triangle(corner_of_triangle(triangle, 0u, hulls) - centre, corner_of_triangle(triangle, 1u, hulls) - centre,
                            corner_of_triangle(triangle, 2u, hulls) - centre);
    vec3 normal = face;
    float distance_to = height;
    if (nearest.count < 3u) {
        vec3 towards = unit3(-nearest.nearest, face);
        normal = allowed_normal(triangle, face, towards, hulls);
        vec3 bent = normal - towards;
        if (dot3(bent, bent) > BENT_SQUARED) return empty_manifold();
        distance_to = -dot3(normal, nearest.nearest);
    }
    return manifold_of_balls(-normal, distance_to, radius, 0.0f, margin);
}

// Any other convex body first. As collide_convex, but a normal that the triangle's edges do not allow is replaced by
// the face normal, with the patch over the face.
LAW ManifoldBuffer collide_convex_triangle(BodyProperties ta, Pose pose_a, BodyProperties tb, Pose pose_b, float margin,
                                           Hulls hulls) {
    ConvexShape own = convex_shape_of(tb, pose_b.orientation, hulls), other = convex_shape_of(ta, pose_a.orientation, hulls);
    vec3 d = pose_a.position - pose_b.position;
    vec4 plane = plane_of(own, 0u, hulls);
    vec3 face = vec3(plane.x, plane.y, plane.z);
    if (!in_front(dot3(face, d) - plane.w, other.scale)) return empty_manifold();
    Separation s = separation_of(own, other, d, margin, hulls);
    if (s.distance >= margin) return empty_manifold();
    float slop = FACE_PREFERENCE * smaller(own.scale, other.scale);
    vec3 normal = allowed_normal(own, face, s.normal, hulls);
    vec3 bent = normal - s.normal;
    bool refused = dot3(bent, bent) > BENT_SQUARED;
    bool on_face = refused || s.by_face_a >= s.distance - slop;
    bool of_b = !on_face && s.by_face_b >= s.distance - slop;
    if (on_face || of_b) {
        ConvexShape first = own, second = other;
        vec3 between = d;
        if (of_b) {
            first = other;
            second = own;
            between = -d;
        }
        ManifoldBuffer touch = manifold_of_face(first, second, between, of_b ? s.face_b : 0u, slop, margin, hulls);
        float by_face = of_b ? s.by_face_b : s.by_face_a;
        bool holds = touch.count > 0u && deepest_of(touch) <= by_face + slop;
        if (refused) {
            if (touch.count == 0u || deepest_of(touch) < s.distance - UNDER_SEAM * other.scale) return empty_manifold();
            return flipped(touch, d);
        }
        if (holds) return of_b ? touch : flipped(touch, d);
    }
    s.normal = normal;
    s.distance = dot3(normal, minkowski_support(own, other, d, normal, hulls)) - other.radius;
    return flipped(manifold_of_lines(own, other, d, s, margin, hulls), d);
}

LAWS_END

#endif
