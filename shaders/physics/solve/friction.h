// Friction of a contact patch: Coulomb friction shared by slip and spin, and rolling resistance.
//
// The friction impulse f (tangential, N s) and its moment t about the normal (N m s) lie within one limit surface
// (Goyal, Ruina, Papadopoulos, Wear 143, 1991): what uniform pressure on the patch can transmit. With the normal
// impulse n, the coefficient mu and the mean distance rho of the patch from its centre,
//   F = x + y + c x y <= 1,   x = |f|^2 / (mu n)^2,   y = t^2 / (mu n rho)^2.
// c = 0.6 follows the quadrature of a disc and of a square within 2% (0.5 near pure spin, 0.7 to 0.8 near pure slip; a
// rectangle of 2:1 averages the same). With c = 0, the ellipsoid of Howe and Cutkosky (1996), discs that spin and slide
// stop 18 to 20% too early.
//
// Where the impulse that stops slip and spin exceeds the surface, friction opposes the slip: (slip, spin) is parallel
// to the gradient of F (maximum dissipation). Shortening the stopping impulse K^-1 slip instead, with K the inverse
// effective mass, would settle at a slip along K f: a box at a yaw of 45 degrees slid 12.7 degrees off course. So a
// step of projected gradient descent is taken, in a metric not below K and a multiple of F's own, in which the
// projection is a division by the length. The factors of that metric are those of the last pass's impulse, so what it
// settles at is exact.
#ifndef SCREE_PHYSICS_FRICTION_H
#define SCREE_PHYSICS_FRICTION_H

#include "shaders/physics/solve/jacobian.h"

LAWS_BEGIN

struct SolveResult {
    Impulse impulse;
    VelocityPair pair_velocity;  // of the split bodies, afterwards
};

// Rolling resistance: an angular impulse against the relative angular velocity, at most rolling_resistance times the
// normal impulse. As friction, it opposes the rotation that it cannot stop.
LAW SolveResult solve_rolling(Constraint c, SolveResult s, float normal, Mass a, Mass b) {
    Mass k;
    k.xx = a.xx * a.split + b.xx * b.split;
    k.xy = a.xy * a.split + b.xy * b.split;
    k.xz = a.xz * a.split + b.xz * b.split;
    k.yy = a.yy * a.split + b.yy * b.split;
    k.yz = a.yz * a.split + b.yz * b.split;
    k.zz = a.zz * a.split + b.zz * b.split;
    // Scaled by the trace: the determinant of a small body's tensor leaves the range of a float.
    float unit = reciprocal((k.xx + k.yy) + k.zz);
    vec3 x = vec3(k.xx, k.xy, k.xz) * unit, y = vec3(k.xy, k.yy, k.yz) * unit, z = vec3(k.xz, k.yz, k.zz) * unit;
    vec3 yz = cross3(y, z), zx = cross3(z, x), xy = cross3(x, y);
    float determinant = reciprocal(dot3(x, yz));
    vec3 spin = (s.pair_velocity.b.angular - s.pair_velocity.a.angular) * unit;
    vec3 stopping = vec3(dot3(yz, spin), dot3(zx, spin), dot3(xy, spin)) * determinant;
    vec3 before = s.impulse.rolling;
    float most = c.rolling_resistance * normal;
    vec3 after = before - stopping;
    bool rolls = dot3(after, after) > most * most;
    if (!none(rolls)) {
        // The greatest row sum is not below the greatest eigenvalue, and equal to it for a ball.
        vec3 sums = (absolute3(x) + absolute3(y)) + absolute3(z);
        float greatest = larger(sums.x, larger(sums.y, sums.z));
        after = choose(rolls, shortened(before - spin * reciprocal(greatest), most), after);
    }
    s.impulse.rolling = after;
    s.pair_velocity = twisted(s.pair_velocity, after - before, a, a.split, b, b.split);
    return s;
}

// Bounds that keep quotients by the friction limit, and a tyre's compliance, within the range of a float while its
// normal impulse is near 0.
CONSTANT float LEAST_HOLD = 1.0e-20f;    // N s
CONSTANT float MAX_COMPLIANCE = 1.0e6f;  // times the inverse effective mass of the bodies

CONSTANT float LIMIT_COUPLING = 0.6f;  // c above

// Below this, squared (0.01 rad/s), the path curves by less than a micrometre a second per metre of radius.
CONSTANT float TURNING_SQUARED = 1.0e-4f;

// The rate at which bodies in uniform rotation slide apart within the coming substep though they do not slip at its
// start: with w x r the velocity of a point, h/2 w x (w x r) + h^2/6 w x (w x (w x r)). Without it, what rests on a
// turntable moves outwards at w^2 r h / 2 (4.6 mm/s at 0.9 of a friction of 0.5), friction or not.
LAW vec3 path_curvature(vec3 angular, vec3 arm, float h) {
    vec3 acceleration = cross3(angular, cross3(angular, arm));
    return acceleration * (0.5f * h) + cross3(angular, acceleration) * (0.16666667f * (h * h));
}

LAW SolveResult solve_friction(Constraint c, SolveResult s, float normal, Mass a, Mass b, Parameters parameters) {
    float most = c.friction * normal;
    vec3 t1 = tangent(c.normal);
    vec3 t2 = cross3(c.normal, t1);
    LeverArms r = lever_arms(c, c.centre, s.impulse.center_offset);
    JacobianRow row1 = jacobian_row(r, t1, a, b);
    JacobianRow row2 = jacobian_row(r, t2, a, b);
    float k11 = row1.inverse_effective_mass_a * a.split + row1.inverse_effective_mass_b * b.split;
    float k22 = row2.inverse_effective_mass_a * a.split + row2.inverse_effective_mass_b * b.split;
    float unit = reciprocal(k11 + k22);
    k11 = k11 * unit;
    k22 = k22 * unit;
    float k12 =
        (dot3(row2.angular_a, row1.angular_response_a) * a.split + dot3(row2.angular_b, row1.angular_response_b) * b.split) *
        unit;
    float slip1 = speed_along(row1, s.pair_velocity) * unit, slip2 = speed_along(row2, s.pair_velocity) * unit;
    vec3 wa = s.pair_velocity.a.angular, wb = s.pair_velocity.b.angular;
    bool turns = dot3(wa, wa) + dot3(wb, wb) > TURNING_SQUARED;
    if (!none(turns)) {
        vec3 drift = (path_curvature(wb, r.b, parameters.h) - path_curvature(wa, r.a, parameters.h)) * unit;
        slip1 = choose(turns, slip1 + dot3(t1, drift), slip1);
        slip2 = choose(turns, slip2 + dot3(t2, drift), slip2);
    }
    bool slips = c.radius_a > 0.0f;
    if (!none(slips)) {
        // Tyre compliance (tyre.h): slip + compliance * impulse = 0, in units of the effective mass.
        float compliance = smaller(c.radius_a * reciprocal(larger(most, LEAST_HOLD)) * unit, MAX_COMPLIANCE);
        k11 = choose(slips, k11 + compliance, k11);
        k22 = choose(slips, k22 + compliance, k22);
        slip1 = choose(slips, slip1 + compliance * dot3(t1, s.impulse.friction), slip1);
        slip2 = choose(slips, slip2 + compliance * dot3(t2, s.impulse.friction), slip2);
    }
    // What stops the spin, then what stops the slip that is left.
    bool twists = c.twist_arm > 0.0f;
    vec3 before = s.impulse.friction;
    float twist = s.impulse.twist, twist_before = twist;
    float spin = 0.0f, spin_mass = 0.0f, left1 = slip1, left2 = slip2;
    if (!none(twists)) {
        vec3 response_a = turned_by(a, c.normal) * a.split, response_b = turned_by(b, c.normal) * b.split;
        spin = dot3(c.normal, wb - wa);
        spin_mass = dot3(c.normal, response_a) + dot3(c.normal, response_b);
        float change = choose(twists, -spin * reciprocal(spin_mass), 0.0f);
        twist = twist + change;
        change = change * unit;
        left1 = left1 + (dot3(row1.angular_a, response_a) + dot3(row1.angular_b, response_b)) * change;
        left2 = left2 + (dot3(row2.angular_a, response_a) + dot3(row2.angular_b, response_b)) * change;
    }
    float inverse = reciprocal(k11 * k22 - k12 * k12);
    vec3 after = before - (t1 * ((k22 * left1 - k12 * left2) * inverse) + t2 * ((k11 * left2 - k12 * left1) * inverse));
    // Beyond the limit surface?
    float arm = choose(twists, c.twist_arm, 1.0f);
    float hold = reciprocal(larger(most, LEAST_HOLD));
    float hold_twist = hold * reciprocal(arm);
    float x = smaller(dot3(after, after) * hold * hold, 4.0f);
    float y = smaller(twist * twist * hold_twist * hold_twist, 4.0f);
    bool slides = x + y + LIMIT_COUPLING * x * y > 1.0f;
    if (!none(slides)) {
        x = smaller(dot3(before, before) * hold * hold, 1.0f);
        y = choose(twists, smaller(twist_before * twist_before * hold_twist * hold_twist, 1.0f), 0.0f);
        float p = 1.0f + LIMIT_COUPLING * y, q = 1.0f + LIMIT_COUPLING * x;
        float bound = 1.0f + LIMIT_COUPLING * x * y;
        float apart = k11 - k22;
        float greatest = 0.5f * ((k11 + k22) + square_root(apart * apart + 4.0f * k12 * k12));
        float turning = spin_mass * unit * arm * arm;
        float step = reciprocal(larger(greatest * q, turning * p));
        vec3 slipped = before - (t1 * slip1 + t2 * slip2) * (q * step);
        float twisting = twist_before * reciprocal(arm) - spin * unit * arm * (p * step);
        twisting = choose(twists, twisting, 0.0f);
        float squared = p * dot3(slipped, slipped) + q * twisting * twisting;
        float scale = choose(squared > bound * most * most, most * bound * inverse_square_root(squared * bound), 1.0f);
        after = choose(slides, slipped * scale, after);
        twist = choose(slides && twists, twisting * scale * arm, twist);
    }
    s.impulse.friction = after;
    if (!none(twists)) {
        s.impulse.twist = choose(twists, twist, twist_before);
        s.pair_velocity =
            choose(twists, twisted(s.pair_velocity, c.normal * (twist - twist_before), a, a.split, b, b.split), s.pair_velocity);
    }
    vec3 change = after - before;
    s.pair_velocity = pushed(s.pair_velocity, row1, dot3(t1, change), a, a.split, b, b.split);
    s.pair_velocity = pushed(s.pair_velocity, row2, dot3(t2, change), a, a.split, b, b.split);
    return s;
}

// Selects the friction impulses and velocities of `s`, or those of `t`; all else is that of `t`.
LAW SolveResult choose(bool condition, SolveResult s, SolveResult t) {
    t.impulse.friction = choose(condition, s.impulse.friction, t.impulse.friction);
    t.impulse.twist = choose(condition, s.impulse.twist, t.impulse.twist);
    t.impulse.rolling = choose(condition, s.impulse.rolling, t.impulse.rolling);
    t.pair_velocity = choose(condition, s.pair_velocity, t.pair_velocity);
    return t;
}
LAW bool has_friction(Impulse impulse) {
    vec3 f = impulse.friction, r = impulse.rolling;
    return f.x != 0.0f || f.y != 0.0f || f.z != 0.0f || impulse.twist != 0.0f || r.x != 0.0f || r.y != 0.0f || r.z != 0.0f;
}

// Friction acts in both passes. In the relax pass alone, which corrects a warm start only once, over-relaxed splitting
// overshoots above 4/3, and boxes at rest spun to and fro about their normals at 0.4 rad/s.
LAW SolveResult solve_patch_friction(Constraint c, SolveResult s, float normal, Mass a, Mass b, Parameters parameters) {
    bool acts = normal != 0.0f || has_friction(s.impulse);
    if (none(acts)) return s;
    bool resists = acts && c.rolling_resistance > 0.0f;
    SolveResult after = s;
    if (!none(resists)) after = choose(resists, solve_rolling(c, s, normal, a, b), s);
    return choose(acts, solve_friction(c, after, normal, a, b, parameters), s);
}

LAWS_END

#endif
