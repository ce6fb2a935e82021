// Contact manifold of two spheres.
#ifndef SCREE_PHYSICS_COLLIDE_SPHERE_SPHERE_H
#define SCREE_PHYSICS_COLLIDE_SPHERE_SPHERE_H

#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// Coincident centres separate along +y.
LAW ManifoldBuffer collide_sphere_sphere(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    vec3 d = pose_b.position - pose_a.position;
    return manifold_of_balls(unit3(d, vec3(0.0f, 1.0f, 0.0f)), length3(d), a.size.x, b.size.x, margin);
}

LAWS_END

#endif
