// Contact Jacobian rows: lever arms, effective masses, and velocity changes by an impulse at a point.
#ifndef SCREE_PHYSICS_JACOBIAN_H
#define SCREE_PHYSICS_JACOBIAN_H

#include "shaders/physics/base/inertia.h"
#include "shaders/physics/solve/constraint.h"

LAWS_BEGIN

struct VelocityPair {
    Velocity a, b;
};
LAW VelocityPair choose(bool condition, VelocityPair v, VelocityPair w) {
    w.a.linear = choose(condition, v.a.linear, w.a.linear);
    w.a.angular = choose(condition, v.a.angular, w.a.angular);
    w.b.linear = choose(condition, v.b.linear, w.b.linear);
    w.b.angular = choose(condition, v.b.angular, w.b.angular);
    return w;
}

// Of a pass over a contact.
struct SolveResult {
    Impulse impulse;
    VelocityPair pair_velocity;  // of the split bodies, afterwards
    vec3 speeds;                 // along the normal (normal_rows.h), before friction
    vec3 push, moment;           // that the pass exerts on B at the centre of the patch, N s and N m s
    vec4 restarts;               // per point, 1: the next substep begins without its normal impulse
};

struct LeverArms {
    vec3 a;
    float pad0;
    vec3 b;
    float pad1;
};
// From each centre of mass to the point; `d` = centre of B minus centre of A, m.
LAW LeverArms lever_arms(Constraint c, vec3 arm, vec3 d) {
    LeverArms arms;
    arms.a = choose(is_on_b(c), arm + d, arm);
    arms.b = choose(is_on_b(c), arm, arm - d);
    arms.pad0 = 0.0f;
    arms.pad1 = 0.0f;
    return arms;
}

// Relative velocity (B minus A) at the point, m/s.
LAW vec3 velocity_at(LeverArms r, VelocityPair v) {
    return (v.b.linear - v.a.linear) + (cross3(v.b.angular, r.b) - cross3(v.a.angular, r.a));
}

// A row of the contact Jacobian, with M^-1 J^T. Effective mass and velocity changes come from the same, present lever
// arms: masses from the start of the step would give a body that flies past another more than it can take.
struct JacobianRow {
    vec3 direction;
    float inverse_effective_mass_a;  // of A alone: 1/m + (r x u).I^-1 (r x u), 1/kg
    vec3 angular_a;                  // r x u, m
    float inverse_effective_mass_b;
    vec3 angular_b;
    float pad0;
    vec3 angular_response_a;  // I^-1 (r x u)
    float pad1;
    vec3 angular_response_b;
    float pad2;
};
LAW JacobianRow jacobian_row(LeverArms r, vec3 direction, Mass a, Mass b) {
    JacobianRow row;
    row.direction = direction;
    row.angular_a = cross3(r.a, direction);
    row.angular_b = cross3(r.b, direction);
    row.angular_response_a = turned_by(a, row.angular_a);
    row.angular_response_b = turned_by(b, row.angular_b);
    row.inverse_effective_mass_a = a.inverse_mass + dot3(row.angular_a, row.angular_response_a);
    row.inverse_effective_mass_b = b.inverse_mass + dot3(row.angular_b, row.angular_response_b);
    row.pad0 = 0.0f;
    row.pad1 = 0.0f;
    row.pad2 = 0.0f;
    return row;
}
// J v: the relative velocity (B minus A) along the row.
LAW float speed_along(JacobianRow row, VelocityPair v) {
    return dot3(row.direction, v.b.linear - v.a.linear) + (dot3(row.angular_b, v.b.angular) - dot3(row.angular_a, v.a.angular));
}
// Applies `impulse` along the row to split body B and its opposite to A.
LAW VelocityPair pushed(VelocityPair v, JacobianRow row, float impulse, Mass a, float split_a, Mass b, float split_b) {
    v.a.linear = v.a.linear - row.direction * (impulse * a.inverse_mass * split_a);
    v.a.angular = v.a.angular - row.angular_response_a * (impulse * split_a);
    v.b.linear = v.b.linear + row.direction * (impulse * b.inverse_mass * split_b);
    v.b.angular = v.b.angular + row.angular_response_b * (impulse * split_b);
    return v;
}
// Applies an angular impulse to split body B and its opposite to A.
LAW VelocityPair twisted(VelocityPair v, vec3 impulse, Mass a, float split_a, Mass b, float split_b) {
    v.a.angular = v.a.angular - turned_by(a, impulse) * split_a;
    v.b.angular = v.b.angular + turned_by(b, impulse) * split_b;
    return v;
}

LAWS_END

#endif
