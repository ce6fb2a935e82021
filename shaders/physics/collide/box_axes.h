// What the laws of boxes share: their axes taken in turn, and how much a face is preferred.
#ifndef SCREE_PHYSICS_BOX_AXES_H
#define SCREE_PHYSICS_BOX_AXES_H

#include "shaders/physics/base/arithmetic.h"

LAWS_BEGIN

// Coordinate k first, the others after it in cyclic order.
LAW vec3 turned(vec3 v, uint k) {
    return vec3(k == 0u ? v.x : (k == 1u ? v.y : v.z), k == 0u ? v.y : (k == 1u ? v.z : v.x),
                k == 0u ? v.z : (k == 1u ? v.x : v.y));
}
// Undoes turned(v, k).
LAW vec3 turned_back(vec3 v, uint k) {
    return vec3(k == 0u ? v.x : (k == 1u ? v.z : v.y), k == 0u ? v.y : (k == 1u ? v.x : v.z),
                k == 0u ? v.z : (k == 1u ? v.y : v.x));
}
// The coordinate of a that is largest; the first of equal ones.
LAW uint largest_of(vec3 a) {
    return a.x >= a.y && a.x >= a.z ? 0u : (a.y >= a.z ? 1u : 2u);
}
LAW float coordinate(vec3 a, uint k) {
    return k == 0u ? a.x : (k == 1u ? a.y : a.z);
}

// What a face may lose against an edge before the edge is taken, and what is flat among a box's points: 5 mm, or 1% of the
// smallest half extent. Without it a resting box would hop from face to edge contact on rounding errors.
LAW float slop_of(vec3 half_extents) {
    float smallest = smaller(half_extents.x, smaller(half_extents.y, half_extents.z));
    return smaller(0.005f, 0.01f * smallest);
}

LAWS_END

#endif
