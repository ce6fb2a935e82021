// Contact manifold of a capsule and a plane.
#ifndef SCREE_PHYSICS_COLLIDE_CAPSULE_PLANE_H
#define SCREE_PHYSICS_COLLIDE_CAPSULE_PLANE_H

#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// One point per end that is within the margin.
LAW ManifoldBuffer collide_capsule_plane(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    vec3 half_axis = upright(pose_a.orientation) * a.size.y;
    float height = -dot3(b.size, pose_b.position - pose_a.position);
    float rise = dot3(b.size, half_axis);
    float low = (height - rise) - a.size.x;
    float high = (height + rise) - a.size.x;
    ManifoldBuffer touch = manifold_along(-b.size);
    touch = with_point(touch, -half_axis - b.size * (a.size.x + 0.5f * low), low, 0u, margin);
    return with_point(a.size.y > 0.0f, touch, half_axis - b.size * (a.size.x + 0.5f * high), high, 1u, margin);
}

LAWS_END

#endif
