// Accessors of a contact constraint: its points, their lever arms, and the body they are fixed to.
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

LAW vec3 lever_arm(Constraint c, int point) {
    return vec3(c.arms_x[point], c.arms_y[point], c.arms_z[point]);
}
LAW Constraint with_lever_arm(Constraint c, int point, vec3 arm) {
    c.arms_x[point] = arm.x;
    c.arms_y[point] = arm.y;
    c.arms_z[point] = arm.z;
    return c;
}

LAWS_END

#endif
