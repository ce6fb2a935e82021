// Shared by box collision: cyclic permutation of axes, and the preference for faces.
#ifndef SCREE_PHYSICS_BOX_AXES_H
#define SCREE_PHYSICS_BOX_AXES_H

#include "shaders/physics/base/arithmetic.h"

LAWS_BEGIN

// Rotates coordinates cyclically so that k is first.
LAW vec3 turned(vec3 v, uint k) {
    return choose(k == 0u, v, choose(k == 1u, vec3(v.y, v.z, v.x), vec3(v.z, v.x, v.y)));
}
// Undoes turned(v, k).
LAW vec3 turned_back(vec3 v, uint k) {
    return choose(k == 0u, v, choose(k == 1u, vec3(v.z, v.x, v.y), vec3(v.y, v.z, v.x)));
}
// Index of the largest coordinate; the first of equals.
LAW uint largest_of(vec3 a) {
    return choose(a.x >= a.y && a.x >= a.z, 0u, choose(a.y >= a.z, 1u, 2u));
}
LAW float coordinate(vec3 a, uint k) {
    return choose(k == 0u, a.x, choose(k == 1u, a.y, a.z));
}

// Slop by which an edge axis must beat a face, and within which box corners count as coplanar: 5 mm, or 1% of the
// smallest half extent. Without it a resting box would alternate between face and edge contacts.
LAW float slop_of(vec3 half_extents) {
    float smallest = smaller(half_extents.x, smaller(half_extents.y, half_extents.z));
    return smaller(0.005f, 0.01f * smallest);
}

LAWS_END

#endif
