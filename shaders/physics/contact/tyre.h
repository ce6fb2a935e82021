// Tyre friction: rises with slip up to the best slip, and falls to that of a sliding tyre.
//
// Slip is the speed of the tread over the ground, relative to the larger of the wheel's travel speed and the tread's
// circumferential speed: 0 for a free-rolling wheel, 1 for a locked one; sideways it is the tangent of the slip angle.
// Friction grows in proportion up to the best slip, then falls to that of a sliding tyre at slip 1 (as brush models and
// measured curves do: Pacejka, Tire and Vehicle Dynamics, chapters 1 and 3), and it opposes the slip in any direction,
// so braking and cornering share one limit.
//
// The rising part would be far too stiff as an explicit force: a light wheel stops slipping within a millisecond. So it
// is the compliance of the friction rows, solved implicitly (contact_solver.h); only the falling part uses the slip at
// the start of the step. A tyre at rest has no compliance, and ordinary friction.
#ifndef SCREE_PHYSICS_TYRE_H
#define SCREE_PHYSICS_TYRE_H

#include "shaders/physics/collide/shape_data.h"
#include "shaders/physics/constraint/surface.h"
#include "shaders/physics/constraint/wrench.h"

LAWS_BEGIN

LAW vec3 along_surface(vec3 normal, vec3 v) {
    return v - normal * dot3(normal, v);
}

// Turns a contact's constraint into a tyre's, of A or of B. `v`: of both bodies as the step begins; d: centre of B
// minus centre of A, m.
LAW Constraint on_tyre(Constraint c, bool is_a, Tyre tyre, vec3 d, VelocityPair v) {
    if (is_of_round_bodies(c)) return c;
    LeverArms r = lever_arms(c, c.centre, d);
    vec3 drive = is_driven(c) ? drive_of(c) : vec3(0.0f);  // of the ground
    vec3 slip = along_surface(c.normal, velocity_at(r, v)) + drive;
    // Travel of the tyre over the ground, as part of the slip of B over A.
    vec3 way = is_a ? (v.b.linear + cross3(v.b.angular, r.b)) - v.a.linear : v.b.linear - (v.a.linear + cross3(v.a.angular, r.a));
    way = along_surface(c.normal, way) + drive;
    float pace = larger(length3(way), length3(slip - way));
    float slipping = length3(slip) * reciprocal(larger(pace, 1.0e-6f));
    float beyond = clamped((slipping - tyre.best_slip) * reciprocal(1.0f - tyre.best_slip), 0.0f, 1.0f);
    c.friction = c.friction * (1.0f - beyond * (1.0f - tyre.sliding));
    c.tyre_slip = tyre.best_slip * pace;
    c.twist_arm = 0.0f;  // torsional friction of a tread is small, and would keep the car straight
    return c;
}

// Matches points across steps as they lie about the wheel, which turns under them.
LAW uvec4 matches_of_tyre(Contact now, Contact before, bool is_a, float radius) {
    uvec4 matches = uvec4(NONE);
    uint taken = 0u;
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= now.count) break;
        vec3 point = is_a ? xyz(now.points[k]) : xyz(now.points[k]) - now.center_offset;
        float nearest = radius * radius;
        for (uint j = 0u; j < 4u; ++j) {
            if (j >= before.count) break;
            vec3 apart = point - (is_a ? xyz(before.points[j]) : xyz(before.points[j]) - before.center_offset);
            float score = dot3(apart, apart);
            if (score < nearest && ((taken >> j) & 1u) == 0u) {
                nearest = score;
                matches[k] = j;
            }
        }
        if (matches[k] != NONE) taken = taken | (1u << matches[k]);
    }
    return matches;
}

LAWS_END

#endif
