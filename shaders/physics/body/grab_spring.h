// Grab spring: a damped spring, scaled with the body's mass, that pulls an anchor of a held body to a target.
#ifndef SCREE_PHYSICS_GRAB_SPRING_H
#define SCREE_PHYSICS_GRAB_SPRING_H

#include "shaders/physics/body/motion.h"

LAWS_BEGIN

// Solves K v = w, K = 1 - [r] (m I^-1) [r], the velocity change of the anchor by an impulse there, for unit mass.
// Symmetric; no eigenvalue is below 1. Written out, because products with a literal zero differ between devices
// (arithmetic.h).
LAW vec3 push_for(vec3 w, vec3 r, Mass mass) {
    float m = reciprocal(mass.inverse_mass);
    vec3 turn_x = vec3(mass.xy * r.z - mass.xz * r.y, mass.yy * r.z - mass.yz * r.y, mass.yz * r.z - mass.zz * r.y) * m;
    vec3 turn_y = vec3(mass.xz * r.x - mass.xx * r.z, mass.yz * r.x - mass.xy * r.z, mass.zz * r.x - mass.xz * r.z) * m;
    vec3 turn_z = vec3(mass.xx * r.y - mass.xy * r.x, mass.xy * r.y - mass.yy * r.x, mass.xz * r.y - mass.yz * r.x) * m;
    vec3 x = cross3(turn_x, r), y = cross3(turn_y, r), z = cross3(turn_z, r);
    float xx = 1.0f + x.x, yy = 1.0f + y.y, zz = 1.0f + z.z;
    float xy = x.y, xz = x.z, yz = y.z;
    // Cramer's rule.
    float a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - xz * yy;
    float d = xx * zz - xz * xz, e = xy * xz - xx * yz, f = xx * yy - xy * xy;
    float determinant = larger((xx * a + xy * b) + xz * c, 1.0f);  // at least 1 in spite of rounding
    return vec3((a * w.x + b * w.y) + c * w.z, (b * w.x + d * w.y) + e * w.z, (c * w.x + e * w.y) + f * w.z) *
           reciprocal(determinant);
}

// The velocity of a held body after one substep. The spring is implicit (Catto, Soft Constraints, GDC 2011), so any
// stiffness is stable, and its impulse is limited in proportion to the mass, so it tears nothing apart. No warm start:
// with one, a jump of the target would throw the body.
LAW Velocity pulled(Velocity velocity, Pose pose, Mass mass, Grip grip, Parameters parameters) {
    vec3 r = rotate(pose.orientation, grip.anchor);
    vec3 gap = (pose.position + r) - grip.target;
    velocity.angular = velocity.angular * grip.spin_kept;
    vec3 now = velocity.linear + cross3(velocity.angular, r);
    vec3 wanted = (now + gap * grip.bias_rate) * -grip.mass_scale;
    vec3 push = shortened(push_for(wanted, r, mass), grip.most);
    velocity.linear = velocity.linear + push;
    velocity.angular = velocity.angular + turned_by(mass, cross3(r, push * reciprocal(mass.inverse_mass)));
    return clamp_velocity(velocity, parameters);
}

LAWS_END

#endif
