// Accessors of a contact constraint: its points, and the body they are fixed to.
#ifndef SCREE_PHYSICS_CONSTRAINT_H
#define SCREE_PHYSICS_CONSTRAINT_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

LAW uint point_count(Constraint c) {
    return c.flags & CONSTRAINT_POINTS;
}
LAW bool is_on_b(Constraint c) {
    return (c.flags & CONSTRAINT_ON_B) != 0u;
}
LAW bool is_of_round_bodies(Constraint c) {
    return (c.flags & CONSTRAINT_ROUND) != 0u;
}

// Whether a pass over its block begins with another contact: the biased pass begins with the first, the relax pass with the last.
LAW bool follows_in_block(Constraint c) {
    return (c.flags & CONSTRAINT_FOLLOWS) != 0u;
}
LAW bool leads_in_block(Constraint c) {
    return (c.flags & CONSTRAINT_LEADS) != 0u;
}

// The centre of curvature of body A, from its centre of mass, m.
LAW vec3 round_centre_of_a(Constraint c) {
    return vec3(c.points_u.x, c.points_u.y, c.points_u.z);
}

LAWS_END

#endif
