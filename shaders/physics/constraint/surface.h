// Surfaces that run over their bodies: conveyor belts.
#ifndef SCREE_PHYSICS_SURFACE_H
#define SCREE_PHYSICS_SURFACE_H

#include "shaders/physics/constraint/constraint.h"

LAWS_BEGIN

// Whether one of the surfaces runs.
LAW bool is_driven(Constraint c) {
    return c.drive1 != 0.0f || c.drive2 != 0.0f;
}
// Slip of B's surface over A's while the bodies stand still, m/s.
LAW vec3 drive_of(Constraint c) {
    vec3 t1 = tangent(c.normal), t2 = cross3(c.normal, t1);
    return t1 * c.drive1 + t2 * c.drive2;
}
// The same drive for another normal.
LAW Constraint with_drive(Constraint c, vec3 drive) {
    vec3 t1 = tangent(c.normal), t2 = cross3(c.normal, t1);
    c.drive1 = dot3(t1, drive);
    c.drive2 = dot3(t2, drive);
    return c;
}

LAW Constraint choose_drive(bool condition, Constraint c, Constraint d) {
    d.drive1 = choose(condition, c.drive1, d.drive1);
    d.drive2 = choose(condition, c.drive2, d.drive2);
    return d;
}

LAWS_END

#endif
