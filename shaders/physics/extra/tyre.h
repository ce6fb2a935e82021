// Tyres: rubber holds by slipping a little, holds best at some slip, and worse when it slides.
//
// The slip is how fast the tread moves over the ground, in parts of how fast the wheel goes along or its tread goes round,
// whichever is faster: 0 of a wheel that rolls freely, 1 of a locked one; sideways it is the tangent of the slip angle. Up to the
// best slip the friction grows in proportion to it, then it falls to that of a sliding tyre at slip 1 (as brush models and
// measured curves do: Pacejka, Tire and Vehicle Dynamics, chapters 1 and 3), and it points against the slip whichever way that
// goes, so that braking and cornering share what there is.
//
// The rising part would be far too stiff for a force known from the slip before: a light wheel stops slipping within a
// millisecond. So it is the compliance of the friction's rows, solved with them (contact_solver.h); only the falling part is
// taken from the slip with which the step begins. A tyre at rest has no compliance: it holds as everything else does.
#ifndef SCREE_PHYSICS_TYRE_H
#define SCREE_PHYSICS_TYRE_H

#include "shaders/physics/collide/shape_data.h"
#include "shaders/physics/solve/jacobian.h"

LAWS_BEGIN

LAW vec3 along_surface(vec3 normal, vec3 v) {
    return v - normal * dot3(normal, v);
}

// The constraint of a contact of a tyre: of A, or of B. `v`: of the two bodies as the step begins; d as in Contact.
LAW Constraint on_tyre(Constraint c, bool is_a, Tyre tyre, vec3 d, VelocityPair v) {
    if (c.anchor == ANCHOR_ROUND) return c;
    LeverArms r = lever_arms(c, c.centre, d);
    vec3 slip = along_surface(c.normal, velocity_at(r, v));
    // How the tyre goes along, seen from the ground, as part of the slip of B over A.
    vec3 way = is_a ? (v.b.linear + cross3(v.b.angular, r.b)) - v.a.linear : v.b.linear - (v.a.linear + cross3(v.a.angular, r.a));
    way = along_surface(c.normal, way);
    float pace = larger(length3(way), length3(slip - way));
    float slipping = length3(slip) * reciprocal(larger(pace, 1.0e-6f));
    float beyond = clamped((slipping - tyre.best_slip) * reciprocal(1.0f - tyre.best_slip), 0.0f, 1.0f);
    c.friction = c.friction * (1.0f - beyond * (1.0f - tyre.sliding));
    c.radius_a = tyre.best_slip * pace;
    c.twist_arm = 0.0f;  // what twists a tread on the ground is small, and would hold the car straight
    return c;
}

// What belongs to which point of the step before: the points stay where they are about the wheel while it turns under them.
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
