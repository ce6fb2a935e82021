// Contact manifold of a sphere and a plane.
#ifndef SCREE_PHYSICS_COLLIDE_SPHERE_PLANE_H
#define SCREE_PHYSICS_COLLIDE_SPHERE_PLANE_H

#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

LAW ManifoldBuffer collide_sphere_plane(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    float height = -dot3(b.size, pose_b.position - pose_a.position);
    return manifold_of_balls(-b.size, height, a.size.x, 0.0f, margin);
}

LAWS_END

#endif
