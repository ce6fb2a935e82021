// How two bodies push each other at a point: lever arms, what a push does to either, and with what mass they meet it.
#ifndef SCREE_PHYSICS_JACOBIAN_H
#define SCREE_PHYSICS_JACOBIAN_H

#include "shaders/physics/base/inertia.h"

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

struct LeverArms {
    vec3 a;
    float pad0;
    vec3 b;
    float pad1;
};
LAW LeverArms lever_arms(Constraint c, vec3 arm, vec3 d) {
    LeverArms arms;
    arms.a = choose(c.anchor == ANCHOR_B, arm + d, arm);
    arms.b = choose(c.anchor == ANCHOR_B, arm, arm - d);
    arms.pad0 = 0.0f;
    arms.pad1 = 0.0f;
    return arms;
}

// Velocity of B against A at a point.
LAW vec3 velocity_at(LeverArms r, VelocityPair v) {
    return (v.b.linear - v.a.linear) + (cross3(v.b.angular, r.b) - cross3(v.a.angular, r.a));
}

// A direction in which the two bodies push each other at a point, with what it does to them. The effective mass and the velocity
// changes come from the same lever arms, those of now: masses from the step's start would, where a body flies past another,
// give it more than it can take.
struct JacobianRow {
    vec3 direction;
    float inverse_effective_mass_a;  // 1/mass of A felt along it: 1/m + (r x u).I^-1 (r x u), 1/kg
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
LAW float mass_along(JacobianRow row, Mass a, Mass b) {
    return reciprocal(row.inverse_effective_mass_a * a.split + row.inverse_effective_mass_b * b.split);
}
// Velocity of B against A along the row.
LAW float speed_along(JacobianRow row, VelocityPair v) {
    return dot3(row.direction, v.b.linear - v.a.linear) + (dot3(row.angular_b, v.b.angular) - dot3(row.angular_a, v.a.angular));
}
// An impulse along the row on B, its opposite on A; the bodies are those lent (split_a, split_b).
LAW VelocityPair pushed(VelocityPair v, JacobianRow row, float impulse, Mass a, float split_a, Mass b, float split_b) {
    v.a.linear = v.a.linear - row.direction * (impulse * a.inverse_mass * split_a);
    v.a.angular = v.a.angular - row.angular_response_a * (impulse * split_a);
    v.b.linear = v.b.linear + row.direction * (impulse * b.inverse_mass * split_b);
    v.b.angular = v.b.angular + row.angular_response_b * (impulse * split_b);
    return v;
}
LAW VelocityPair twisted(VelocityPair v, vec3 impulse, Mass a, float split_a, Mass b, float split_b) {
    v.a.angular = v.a.angular - turned_by(a, impulse) * split_a;
    v.b.angular = v.b.angular + turned_by(b, impulse) * split_b;
    return v;
}

LAWS_END

#endif
