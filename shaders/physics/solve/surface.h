// Surfaces that run over their bodies: conveyor belts.
#ifndef SCREE_PHYSICS_SURFACE_H
#define SCREE_PHYSICS_SURFACE_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

// Whether one of the surfaces runs.
LAW bool is_driven(Constraint c) {
    return c.arms[0].w != 0.0f || c.arms[1].w != 0.0f;
}
// Slip of B's surface over A's while the bodies stand still, m/s.
LAW vec3 drive_of(Constraint c) {
    vec3 t1 = tangent(c.normal), t2 = cross3(c.normal, t1);
    return t1 * c.arms[0].w + t2 * c.arms[1].w;
}
// The same drive for another normal.
LAW Constraint with_drive(Constraint c, vec3 drive) {
    vec3 t1 = tangent(c.normal), t2 = cross3(c.normal, t1);
    c.arms[0].w = dot3(t1, drive);
    c.arms[1].w = dot3(t2, drive);
    return c;
}

// Quiet steps that the other body shows (sleep.h) beside a running surface or a moving kinematic body: no body sleeps there.
CONSTANT float BESIDE_MOVING = -1.0f;

LAW Constraint choose_drive(bool condition, Constraint c, Constraint d) {
    d.arms[0].w = choose(condition, c.arms[0].w, d.arms[0].w);
    d.arms[1].w = choose(condition, c.arms[1].w, d.arms[1].w);
    return d;
}

LAWS_END

#endif
