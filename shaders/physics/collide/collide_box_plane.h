// Contact manifold of a box and a plane.
#ifndef SCREE_PHYSICS_COLLIDE_BOX_PLANE_H
#define SCREE_PHYSICS_COLLIDE_BOX_PLANE_H

#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// The corners of the face towards the plane, which include the deepest. Features are box corners, coded by three signs.
LAW ManifoldBuffer collide_box_plane(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    vec3 normal = rotate_back(pose_a.orientation, b.size);
    float height = -dot3(b.size, pose_b.position - pose_a.position);
    vec3 slant = absolute3(normal);
    uint face = choose(slant.y >= slant.x && slant.y >= slant.z, 1u, choose(slant.x >= slant.z, 0u, 2u));
    ManifoldBuffer touch = manifold_along(-b.size);
    for (int k = 0; k < 4; ++k) {
        float first = (k & 1) == 0 ? -1.0f : 1.0f;
        float second = (k & 2) == 0 ? -1.0f : 1.0f;
        vec3 of_x = vec3(choose(normal.x > 0.0f, -1.0f, 1.0f), first, second);
        vec3 of_y = vec3(first, choose(normal.y > 0.0f, -1.0f, 1.0f), second);
        vec3 of_z = vec3(first, second, choose(normal.z > 0.0f, -1.0f, 1.0f));
        vec3 signs = choose(face == 0u, of_x, choose(face == 1u, of_y, of_z));
        vec3 corner = signs * a.size;
        float separation = height + dot3(normal, corner);
        uint feature = choose(signs.x > 0.0f, 1u, 0u) + choose(signs.y > 0.0f, 2u, 0u) + choose(signs.z > 0.0f, 4u, 0u);
        vec3 point = rotate(pose_a.orientation, corner) - b.size * (0.5f * separation);
        touch = with_point(touch, point, separation, feature, margin);
    }
    return touch;
}

LAWS_END

#endif
