// Contact manifold of a sphere and a capsule.
#ifndef SCREE_PHYSICS_COLLIDE_SPHERE_CAPSULE_H
#define SCREE_PHYSICS_COLLIDE_SPHERE_CAPSULE_H

#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// A sphere centred on the capsule's axis is pushed out sideways.
LAW ManifoldBuffer collide_sphere_capsule(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    vec3 d = pose_b.position - pose_a.position;
    vec3 axis = upright(pose_b.orientation);
    vec3 nearest = d + axis * clamped(-dot3(axis, d), -b.size.y, b.size.y);
    return manifold_of_balls(unit3(nearest, tangent(axis)), length3(nearest), a.size.x, b.size.x, margin);
}

LAWS_END

#endif
