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
    vec3 upwards = vec3(0.0f, choose(centre.y < 0.0f, -1.0f, 1.0f), 0.0f), outward = unit3(excess, upwards);
    // At a distance within the rounding of its coordinates the excess has no direction.
    bool inside = gap <= 1.0e-5f * a.size.x;
    if (!none(inside)) {
        vec3 depths = absolute3(centre) - b.size;
        bool by_x = depths.x > depths.y, by_z = depths.z > choose(by_x, depths.x, depths.y);
        vec3 sideways = choose(by_x, vec3(choose(centre.x < 0.0f, -1.0f, 1.0f), 0.0f, 0.0f), upwards);
        vec3 ahead = vec3(0.0f, 0.0f, choose(centre.z < 0.0f, -1.0f, 1.0f));
        outward = choose(inside, choose(by_z, ahead, sideways), outward);
        gap = choose(inside, choose(by_z, depths.z, choose(by_x, depths.x, depths.y)), gap);
    }
    return manifold_of_balls(-rotate(pose_b.orientation, outward), gap, a.size.x, 0.0f, margin);
}

LAWS_END

#endif
