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
//
// A patch that sticks is anchored: its stretch, the way of B over A since it sticks, is a soft constraint as penetration is
// (contact_solver.h), with the same spring, leak and relaxation; stretch and friction turn with the bodies. Without an
// anchor what a pass leaves of the slip adds up. Stacks of five on a turntable, at a fifth of what friction bears, crept
// in 20 s by 20 to 70 mm; by 4 mm once friction turned with the bodies; and by 0.1 mm with an anchor (by 9 and 13 mm
// with a third and a tenth of its spring and leak). Where friction slides, the stretch is that at which the soft
// constraint transmits its force (return mapping), so it can stick again at once: with none, two boxes at 0.9 of what
// friction bears crept three times as fast. One and two points have no anchor: what rolls would swing on it.
#ifndef SCREE_PHYSICS_FRICTION_H
#define SCREE_PHYSICS_FRICTION_H

#include "shaders/physics/solve/jacobian.h"
#include "shaders/physics/solve/surface.h"

LAWS_BEGIN

// Rolling resistance: an angular impulse against the relative angular velocity, at most rolling_resistance times the
// normal impulse. As friction, it opposes the rotation that it cannot stop.
LAW SolveResult solve_rolling(Constraint c, SolveResult s, float normal, Mass a, Mass b) {
    float xy_entry = a.xy * a.split + b.xy * b.split;
    float xz_entry = a.xz * a.split + b.xz * b.split;
    float yz_entry = a.yz * a.split + b.yz * b.split;
    // Rows of the inverse effective mass.
    vec3 x = vec3(a.xx * a.split + b.xx * b.split, xy_entry, xz_entry);
    vec3 y = vec3(xy_entry, a.yy * a.split + b.yy * b.split, yz_entry);
    vec3 z = vec3(xz_entry, yz_entry, a.zz * a.split + b.zz * b.split);
    // Scaled by the trace: the determinant of a small body's tensor leaves the range of a float.
    float unit = reciprocal((x.x + y.y) + z.z);
    x = x * unit;
    y = y * unit;
    z = z * unit;
    vec3 yz = cross3(y, z), zx = cross3(z, x), xy = cross3(x, y);
    float determinant = reciprocal(dot3(x, yz));
    vec3 spin = (s.pair_velocity.b.angular - s.pair_velocity.a.angular) * unit;
    vec3 stopping = vec3(dot3(yz, spin), dot3(zx, spin), dot3(xy, spin)) * determinant;
    bool spins = (c.flags & CONSTRAINT_ROLLS_ONLY) != 0u;  // freely, but for the friction of the patch
    if (!none(spins)) {
        spin = choose(spins, spin - c.normal * dot3(c.normal, spin), spin);
        stopping = choose(spins, stopping - c.normal * dot3(c.normal, stopping), stopping);
    }
    vec3 before = s.impulse.rolling, from = before;
    if (!none(spins)) from = choose(spins, before - c.normal * dot3(c.normal, before), before);
    float most = c.rolling_resistance * normal;
    vec3 after = flush_tiny(from - stopping);
    bool rolls = dot3(after, after) > most * most;
    if (!none(rolls)) {
        // The greatest row sum is not below the greatest eigenvalue, and equal to it for a ball.
        vec3 sums = (absolute3(x) + absolute3(y)) + absolute3(z);
        float greatest = larger(sums.x, larger(sums.y, sums.z));
        after = choose(rolls, flush_tiny(shortened(flush_tiny(from - spin * reciprocal(greatest)), most)), after);
    }
    s.impulse.rolling = after;
    s.moment = s.moment + (after - before);
    s.pair_velocity = twisted(s.pair_velocity, after - before, a, a.split, b, b.split);
    return s;
}

// Bounds that keep quotients by the friction limit, and a tyre's compliance, within the range of a float while its
// normal impulse is near 0.
CONSTANT float LEAST_HOLD = 1.0e-16f;    // N s; friction at its limit is then not flushed
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

// The anchor of a patch that sticks, in one pass: friction transmits -K^-1 (slip + rate * stretch), less `leak` of it.
struct Anchor {
    float rate;  // 1/s
    float leak;
    float give;  // leak / rate in the biased pass, s
    float pad0;
};
LAW Anchor anchor_of_pass(Constraint c, bool biased, Parameters parameters) {
    // What touches in one or two points may roll, and a tyre has a compliance of its own.
    bool anchored = point_count(c) > 2u && !(c.tyre_slip > 0.0f);
    Anchor anchor;
    anchor.rate = choose(anchored && biased, parameters.bias_rate, 0.0f);
    anchor.leak = choose(anchored && biased, parameters.impulse_scale, 0.0f);
    anchor.give = choose(anchored, parameters.impulse_scale * reciprocal(parameters.bias_rate), 0.0f);
    anchor.pad0 = 0.0f;
    return anchor;
}

// After the positions were integrated with `v`: the patch's stretch, which turns with the bodies as its friction does.
LAW Impulse stretched(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    LeverArms r = lever_arms(c, c.centre, impulse.center_offset);
    vec3 slip = velocity_at(r, v);
    bool driven = is_driven(c);
    if (!none(driven)) slip = choose(driven, slip + drive_of(c), slip);
    vec3 wa = v.a.angular, wb = v.b.angular;
    bool turns = dot3(wa, wa) + dot3(wb, wb) > TURNING_SQUARED;
    if (!none(turns)) {
        vec3 curve_a = path_curvature(shortened(wa, parameters.max_spin), r.a, parameters.h);
        vec3 curve_b = path_curvature(shortened(wb, parameters.max_spin), r.b, parameters.h);
        slip = choose(turns, slip + (curve_b - curve_a), slip);
    }
    slip = slip - c.normal * dot3(slip, c.normal);
    float angle = (0.5f * parameters.h) * dot3(c.normal, wa + wb);
    vec3 stretch = impulse.stretch - c.normal * dot3(impulse.stretch, c.normal);
    stretch = (stretch + cross3(c.normal, stretch) * angle) + slip * parameters.h;
    float turn = impulse.turn + parameters.h * dot3(c.normal, wb - wa);
    bool loaded = (impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w) > 0.0f;
    impulse.stretch = choose(loaded, flush_tiny(stretch), vec3(0.0f));
    impulse.turn = choose(loaded, flush_tiny(turn), 0.0f);
    vec3 friction = impulse.friction;
    impulse.friction = flush_tiny(friction + cross3(c.normal, friction) * angle - friction * (0.5f * angle * angle));
    return impulse;
}

// Both tangents as one 2x2 block, scaled by `unit` so that its trace is 1.
struct FrictionBlock {
    JacobianRow row1, row2;
    float k11, k22, k12, unit;
    float slip1, slip2;  // m/s, scaled
    float pad0, pad1;
};
LAW FrictionBlock friction_block(LeverArms r, vec3 normal, VelocityPair v, Mass a, Mass b, Parameters parameters) {
    FrictionBlock k;
    vec3 t1 = tangent(normal), t2 = cross3(normal, t1);
    k.row1 = jacobian_row(r, t1, a, b);
    k.row2 = jacobian_row(r, t2, a, b);
    float k11 = k.row1.inverse_effective_mass_a * a.split + k.row1.inverse_effective_mass_b * b.split;
    float k22 = k.row2.inverse_effective_mass_a * a.split + k.row2.inverse_effective_mass_b * b.split;
    k.unit = reciprocal(k11 + k22);
    k.k11 = k11 * k.unit;
    k.k22 = k22 * k.unit;
    k.k12 = (dot3(k.row2.angular_a, k.row1.angular_response_a) * a.split +
             dot3(k.row2.angular_b, k.row1.angular_response_b) * b.split) *
            k.unit;
    k.slip1 = speed_along(k.row1, v) * k.unit;
    k.slip2 = speed_along(k.row2, v) * k.unit;
    vec3 wa = v.a.angular, wb = v.b.angular;
    bool turns = dot3(wa, wa) + dot3(wb, wb) > TURNING_SQUARED;
    if (!none(turns)) {
        // Bodies may spin beyond the limit within a pass, where the series diverges.
        vec3 curve_a = path_curvature(shortened(wa, parameters.max_spin), r.a, parameters.h);
        vec3 curve_b = path_curvature(shortened(wb, parameters.max_spin), r.b, parameters.h);
        vec3 drift = (curve_b - curve_a) * k.unit;
        k.slip1 = choose(turns, k.slip1 + dot3(t1, drift), k.slip1);
        k.slip2 = choose(turns, k.slip2 + dot3(t2, drift), k.slip2);
    }
    k.pad0 = 0.0f;
    k.pad1 = 0.0f;
    return k;
}
// Tyre compliance (tyre.h): slip + compliance * impulse = 0, in units of the effective mass.
LAW FrictionBlock with_compliance(FrictionBlock k, bool slips, float compliance, vec3 friction) {
    k.k11 = choose(slips, k.k11 + compliance, k.k11);
    k.k22 = choose(slips, k.k22 + compliance, k.k22);
    k.slip1 = choose(slips, k.slip1 + compliance * dot3(k.row1.direction, friction), k.slip1);
    k.slip2 = choose(slips, k.slip2 + compliance * dot3(k.row2.direction, friction), k.slip2);
    return k;
}

struct PatchImpulse {
    vec3 friction;
    float twist;
};
// The impulse of a patch that slides or spins: a step of projected gradient descent from `before`. `spin` and
// `spin_mass` (rad/s; 1 / (kg m^2), 0 without torsional friction) are scaled as the block; F's terms by arm^2. `resists`:
// the impulse is on the surface at once. A step of spin on an arm that is short beside the body is a small part of the
// limit, and spinning resistance would act like a viscous one. (With that for every patch, columns of tables on feet fell.)
LAW PatchImpulse slid(FrictionBlock k, PatchImpulse before, float spin, float spin_mass, float arm, float hold, bool resists) {
    // Squares are of quotients by the friction limit: the squares of impulses on grains leave the range of a float.
    vec3 held = before.friction * hold;
    float area = arm * arm, x = smaller(dot3(held, held), 1.0f), y = before.twist * hold;
    y = smaller(y * y, area);
    float p = area + LIMIT_COUPLING * y, q = 1.0f + LIMIT_COUPLING * x;
    float bound = area + LIMIT_COUPLING * x * y;
    // Not below the block's greatest eigenvalue (Gershgorin).
    float greatest = larger(k.k11, k.k22) + abs(k.k12);
    float step = reciprocal(larger(greatest * q, spin_mass * p));
    PatchImpulse after;
    after.friction = flush_tiny(before.friction - (k.row1.direction * k.slip1 + k.row2.direction * k.slip2) * (q * step));
    after.twist = flush_tiny(before.twist - spin * (p * step));
    // Bounded, for a contact that has all but let go: the square of its quotient leaves the range of a float.
    vec3 quotient = after.friction * hold;
    float turned = after.twist * hold, squared = smaller(p * dot3(quotient, quotient) + q * turned * turned, 1.0e30f);
    float scale = bound * inverse_square_root(larger(squared, 1.0e-30f) * bound);
    scale = choose(resists || squared > bound, scale, 1.0f);
    after.friction = flush_tiny(after.friction * scale);
    after.twist = flush_tiny(after.twist * scale);
    return after;
}

LAW SolveResult solve_friction(Constraint c, SolveResult s, float normal, Mass a, Mass b, bool biased, Parameters parameters) {
    float most = c.friction * normal;
    PatchImpulse before, after;
    // What stops the spin, then what stops the slip that is left; without a normal impulse, nothing.
    bool holds = most > 0.0f, twists = c.twist_arm > 0.0f, slips = c.tyre_slip > 0.0f;
    before.friction = s.impulse.friction;
    before.twist = choose(twists, s.impulse.twist, 0.0f);  // of a patch that has lost its arm nothing would take it back
    after.twist = before.twist;
    VelocityPair v = s.pair_velocity;
    Anchor anchor = anchor_of_pass(c, biased, parameters);
    float spin = 0.0f, spin_mass = 0.0f, stopping = 0.0f;
    vec3 response_a = c.normal, response_b = c.normal;
    if (!none(twists)) {
        response_a = choose(twists, turned_by(a, c.normal) * a.split, c.normal);
        response_b = choose(twists, turned_by(b, c.normal) * b.split, c.normal);
        spin = choose(twists, dot3(c.normal, v.b.angular - v.a.angular), 0.0f);
        spin_mass = dot3(c.normal, response_a) + dot3(c.normal, response_b);
        stopping = (spin + anchor.rate * s.impulse.turn) * reciprocal(spin_mass);
        stopping = choose(holds, -stopping - anchor.leak * before.twist, -before.twist);
        stopping = choose(twists, stopping, 0.0f);  // in lanes beside ones that do
        spin_mass = choose(twists, spin_mass, 0.0f);
        after.twist = choose(twists, flush_tiny(before.twist + stopping), before.twist);
        v.a.angular = choose(twists, v.a.angular - response_a * stopping, v.a.angular);
        v.b.angular = choose(twists, v.b.angular + response_b * stopping, v.b.angular);
    }
    FrictionBlock k = friction_block(lever_arms(c, c.centre, s.impulse.center_offset), c.normal, v, a, b, parameters);
    // The block's tangents are those of the drive.
    bool driven = is_driven(c);
    if (!none(driven)) {
        k.slip1 = choose(driven, k.slip1 + c.drive1 * k.unit, k.slip1);
        k.slip2 = choose(driven, k.slip2 + c.drive2 * k.unit, k.slip2);
    }
    if (!none(slips)) {
        float compliance = smaller(c.tyre_slip * reciprocal(larger(most, LEAST_HOLD)) * k.unit, MAX_COMPLIANCE);
        k = with_compliance(k, slips, compliance, before.friction);
    }
    float inverse = reciprocal(k.k11 * k.k22 - k.k12 * k.k12);
    float bias = anchor.rate * k.unit;
    float slip1 = k.slip1 + bias * dot3(k.row1.direction, s.impulse.stretch);
    float slip2 = k.slip2 + bias * dot3(k.row2.direction, s.impulse.stretch);
    vec3 stop = k.row1.direction * ((k.k22 * slip1 - k.k12 * slip2) * inverse) +
                k.row2.direction * ((k.k11 * slip2 - k.k12 * slip1) * inverse);
    after.friction = flush_tiny(before.friction - choose(holds, stop + before.friction * anchor.leak, before.friction));
    // Beyond the limit surface?
    float arm = choose(twists, c.twist_arm, 1.0f);
    float hold = reciprocal(larger(most, LEAST_HOLD));
    // What sticks holds up to the static friction; what does not slides by the dynamic one.
    float hold_sticking = hold;
    bool clings = c.static_friction > 0.0f;
    if (!none(clings)) hold_sticking = choose(clings, reciprocal(larger(c.static_friction * normal, LEAST_HOLD)), hold);
    vec3 held = after.friction * hold_sticking;
    float x = dot3(held, held), y = after.twist * hold_sticking;
    y = smaller(y * y, 4.0f * arm * arm);
    bool slides = holds && x * (arm * arm + LIMIT_COUPLING * y) + y > arm * arm;
    if (!none(slides)) {
        // The slip before the spin was stopped.
        float undone = stopping * k.unit;
        k.slip1 = k.slip1 - (dot3(k.row1.angular_a, response_a) + dot3(k.row1.angular_b, response_b)) * undone;
        k.slip2 = k.slip2 - (dot3(k.row2.angular_a, response_a) + dot3(k.row2.angular_b, response_b)) * undone;
        bool resists = (c.flags & CONSTRAINT_ROLLS_ONLY) != 0u && !(anchor.give > 0.0f);  // spinning, with its own arm
        PatchImpulse sliding = slid(k, before, spin * k.unit, spin_mass * k.unit, arm, hold, resists);
        after.friction = choose(slides, sliding.friction, after.friction);
        float turned_back = choose(slides && twists, sliding.twist - after.twist, 0.0f);
        after.twist = after.twist + turned_back;
        v.a.angular = v.a.angular - response_a * turned_back;
        v.b.angular = v.b.angular + response_b * turned_back;
    }
    // A patch that slides keeps the stretch at which the soft constraint transmits its friction: it can stick at once.
    if (!none(slides)) {
        float f1 = dot3(k.row1.direction, after.friction), f2 = dot3(k.row2.direction, after.friction);
        float scale = anchor.give * reciprocal(k.unit);
        vec3 stretch = k.row1.direction * (k.k11 * f1 + k.k12 * f2) + k.row2.direction * (k.k12 * f1 + k.k22 * f2);
        s.impulse.stretch = choose(slides, stretch * -scale, s.impulse.stretch);
        s.impulse.turn = choose(slides, -anchor.give * spin_mass * after.twist, s.impulse.turn);
    }
    bool anchored = holds && anchor.give > 0.0f;
    s.impulse.stretch = choose(anchored, flush_tiny(s.impulse.stretch), vec3(0.0f));
    s.impulse.turn = choose(anchored, flush_tiny(s.impulse.turn), 0.0f);
    s.impulse.friction = after.friction;
    s.impulse.twist = after.twist;
    vec3 change = after.friction - before.friction;
    s.push = s.push + change;
    s.moment = s.moment + c.normal * (after.twist - before.twist);
    s.pair_velocity = pushed(v, k.row1, dot3(k.row1.direction, change), a, a.split, b, b.split);
    s.pair_velocity = pushed(s.pair_velocity, k.row2, dot3(k.row2.direction, change), a, a.split, b, b.split);
    return s;
}

// Selects the friction impulses and velocities of `s`, or those of `t`; all else is that of `t`.
LAW SolveResult choose(bool condition, SolveResult s, SolveResult t) {
    t.impulse.friction = choose(condition, s.impulse.friction, t.impulse.friction);
    t.impulse.twist = choose(condition, s.impulse.twist, t.impulse.twist);
    t.impulse.rolling = choose(condition, s.impulse.rolling, t.impulse.rolling);
    t.impulse.stretch = choose(condition, s.impulse.stretch, t.impulse.stretch);
    t.impulse.turn = choose(condition, s.impulse.turn, t.impulse.turn);
    t.pair_velocity = choose(condition, s.pair_velocity, t.pair_velocity);
    t.push = choose(condition, s.push, t.push);
    t.moment = choose(condition, s.moment, t.moment);
    return t;
}
LAW bool has_friction(Impulse impulse) {
    vec3 f = impulse.friction, r = impulse.rolling;
    return f.x != 0.0f || f.y != 0.0f || f.z != 0.0f || impulse.twist != 0.0f || r.x != 0.0f || r.y != 0.0f || r.z != 0.0f;
}

// The relax pass changes normal impulses, and friction with them where it slides: what lies on the limit surface stays there.
// `biased`, `normal`: normal impulses before and after, N s.
LAW SolveResult with_sliding_friction(Constraint c, SolveResult s, float biased, float normal) {
    float hold = reciprocal(larger(c.friction * biased, LEAST_HOLD));
    vec3 held = s.impulse.friction * hold;
    float arm = choose(c.twist_arm > 0.0f, c.twist_arm, 1.0f), area = arm * arm;
    float x = smaller(dot3(held, held), 4.0f), y = s.impulse.twist * hold;
    y = smaller(y * y, 4.0f * area);
    bool slides = c.friction * biased > LEAST_HOLD && x * (area + LIMIT_COUPLING * y) + y > 0.999f * area;
    float change = choose(slides, normal * reciprocal(larger(biased, LEAST_HOLD)) - 1.0f, 0.0f);
    vec3 push = s.impulse.friction * change;
    float twist = s.impulse.twist * change;
    s.impulse.friction = flush_tiny(s.impulse.friction + push);
    s.impulse.twist = flush_tiny(s.impulse.twist + twist);
    s.push = s.push + push;
    s.moment = s.moment + c.normal * twist;
    return s;
}

LAW SolveResult solve_patch_friction(Constraint c, SolveResult s, float normal, Mass a, Mass b, bool biased,
                                     Parameters parameters) {
    bool acts = normal != 0.0f || has_friction(s.impulse);
    if (none(acts)) return s;
    bool resists = acts && c.rolling_resistance != 0.0f;
    SolveResult after = s;
    if (!none(resists)) after = choose(resists, solve_rolling(c, s, normal, a, b), s);
    after = solve_friction(c, after, normal, a, b, biased, parameters);
    if (none(!acts)) return after;
    return choose(acts, after, s);
}

LAWS_END

#endif
