// What a contact reads and changes: the velocities of its two bodies, their lever arms, and what a pass exerts.
#ifndef SCREE_PHYSICS_WRENCH_H
#define SCREE_PHYSICS_WRENCH_H

#include "shaders/physics/base/contact_impulse.h"
#include "shaders/physics/base/inertia.h"
#include "shaders/physics/constraint/constraint.h"

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
    vec3 b;
};
// From each centre of mass to the point; `d` = centre of B minus centre of A, m.
LAW LeverArms lever_arms(Constraint c, vec3 arm, vec3 d) {
    LeverArms arms;
    arms.a = choose(is_on_b(c), arm + d, arm);
    arms.b = choose(is_on_b(c), arm, arm - d);
    return arms;
}

// Relative velocity (B minus A) at the point, m/s.
LAW vec3 velocity_at(LeverArms r, VelocityPair v) {
    return (v.b.linear - v.a.linear) + (cross3(v.b.angular, r.b) - cross3(v.a.angular, r.a));
}

// What a contact exerts on B at the centre of its patch, N s and N m s.
struct Wrench {
    vec3 push, moment;
};
LAW Wrench plus(Wrench a, Wrench b) {
    a.push = a.push + b.push;
    a.moment = a.moment + b.moment;
    return a;
}
// Of a pass over a contact.
struct SolveResult {
    Impulse impulse;
    VelocityPair pair_velocity;  // of the split bodies, afterwards
    vec3 speeds;                 // along the normal (normal_rows.h), before friction
    Wrench wrench;               // that the pass exerts
    vec4 restarts;               // per point, 1: the next substep begins without its normal impulse
};

// The velocity changes of the whole (not split) bodies. Both feel the push at the same point.
LAW VelocityPair changes_by(Wrench wrench, LeverArms r, Mass a, Mass b) {
    VelocityPair change;
    change.a.linear = vec3(0.0f) - wrench.push * a.inverse_mass;
    change.a.angular = vec3(0.0f) - turned_by(a, cross3(r.a, wrench.push) + wrench.moment);
    change.b.linear = wrench.push * b.inverse_mass;
    change.b.angular = turned_by(b, cross3(r.b, wrench.push) + wrench.moment);
    change.a.low_y = change.a.low_z = change.b.low_y = change.b.low_z = 0.0f;
    return change;
}
// The velocities of the split bodies after it.
LAW VelocityPair exerted(VelocityPair v, Wrench wrench, LeverArms r, Mass a, Mass b) {
    VelocityPair change = changes_by(wrench, r, a, b);
    v.a.linear = v.a.linear + change.a.linear * a.split;
    v.a.angular = v.a.angular + change.a.angular * a.split;
    v.b.linear = v.b.linear + change.b.linear * b.split;
    v.b.angular = v.b.angular + change.b.angular * b.split;
    return v;
}

LAWS_END

#endif
