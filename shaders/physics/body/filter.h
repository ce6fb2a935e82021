// Collision filters: which bodies and parts collide at all, decided before any geometry.
//
// A row's filter: category and mask, a bit set each; group; head of its body's list of excluded partners (NONE: none).
// An entry of that list: the partner's id, the next entry, two unused words.
#ifndef SCREE_PHYSICS_FILTER_H
#define SCREE_PHYSICS_FILTER_H

#include "shaders/physics/base/records.h"

LAWS_BEGIN

// In an equal group other than 0 a positive one always collides, a negative one never; else each must be in a category
// of the other's mask.
LAW bool filters_allow(uvec4 a, uvec4 b) {
    if (a.z == b.z && a.z != 0u) return a.z < 0x80000000u;
    return (a.x & b.y) != 0u && (b.x & a.y) != 0u;
}

LAWS_END

#endif
