// Contact manifold of two capsules.
#ifndef SCREE_PHYSICS_COLLIDE_CAPSULE_CAPSULE_H
#define SCREE_PHYSICS_COLLIDE_CAPSULE_CAPSULE_H

#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// One point between the nearest points of the axes (Ericson, Real-Time Collision Detection, 5.1.9). Two, at the ends of
// the common interval, for nearly parallel axes that diverge there by less than a tenth of the radii (gap error at most
// 1/200 of them; 1/50 where the nearest point of the other axis is its end). Crossing axes separate along their common
// perpendicular.
LAW ManifoldBuffer collide_capsule_capsule(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    vec3 d = pose_b.position - pose_a.position;
    vec3 u = upright(pose_a.orientation);
    vec3 v = upright(pose_b.orientation);
    float half_a = a.size.y;
    float half_b = b.size.y;
    float radii = a.size.x + b.size.x;
    float cosine = dot3(u, v);
    float along_u = dot3(u, d);
    float along_v = dot3(v, d);
    float reach = half_b * abs(cosine);
    float low = clamped(along_u - reach, -half_a, half_a);
    float high = clamped(along_u + reach, -half_a, half_a);

    vec3 across = cross3(u, v);
    float squared = dot3(across, across);
    float crossing = clamped(dot3(cross3(d, v), across) * reciprocal(squared), -half_a, half_a);
    float s = choose(squared > 1.0e-6f, crossing, 0.5f * (low + high));
    float t = cosine * s - along_v;
    bool beyond = abs(t) > half_b;
    t = clamped(t, -half_b, half_b);
    s = choose(beyond, clamped(along_u + cosine * t, -half_a, half_a), s);
    vec3 between = d + v * t - u * s;
    float gap = length3(between);
    vec3 sideways = unit3(across, tangent(u));
    vec3 normal = choose(gap > 1.0e-5f * radii, unit3(between, sideways), sideways);

    ManifoldBuffer touch = manifold_along(normal);
    float shared_length = high - low;
    float parting = 0.1f * radii;
    bool parallel = squared < 0.03f && squared * shared_length * shared_length < parting * parting;
    bool two = parallel && shared_length > 0.01f * radii;
    float separation = gap - radii;
    touch = with_point(!two, touch, u * s + normal * (a.size.x + 0.5f * separation), separation, 0u, margin);
    if (!none(two)) {
        for (int k = 0; k < 2; ++k) {
            s = k == 0 ? low : high;
            t = clamped(cosine * s - along_v, -half_b, half_b);
            separation = dot3(normal, d + v * t - u * s) - radii;
            touch = with_point(two, touch, u * s + normal * (a.size.x + 0.5f * separation), separation, uint(1 + k), margin);
        }
    }
    return touch;
}

LAWS_END

#endif
