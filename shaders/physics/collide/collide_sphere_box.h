// Contact manifold of a sphere and a box.
#ifndef SCREE_PHYSICS_COLLIDE_SPHERE_BOX_H
#define SCREE_PHYSICS_COLLIDE_SPHERE_BOX_H

#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// A centre inside the box is pushed out through the nearest face: of equals y, then x, then z.
LAW ManifoldBuffer collide_sphere_box(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    vec3 centre = rotate_back(pose_b.orientation, pose_a.position - pose_b.position);
    vec3 excess = centre - larger3(-b.size, smaller3(centre, b.size));
    float gap = length3(excess);
    vec3 outward = vec3(0.0f, centre.y < 0.0f ? -1.0f : 1.0f, 0.0f);
    // At a distance within the rounding of its coordinates the excess has no direction.
    if (gap > 1.0e-5f * a.size.x) {
        outward = unit3(excess, outward);
    } else {
        vec3 inside = absolute3(centre) - b.size;
        gap = inside.y;
        if (inside.x > gap) {
            gap = inside.x;
            outward = vec3(centre.x < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f);
        }
        if (inside.z > gap) {
            gap = inside.z;
            outward = vec3(0.0f, 0.0f, centre.z < 0.0f ? -1.0f : 1.0f);
        }
    }
    return manifold_of_balls(-rotate(pose_b.orientation, outward), gap, a.size.x, 0.0f, margin);
}

LAWS_END

#endif
