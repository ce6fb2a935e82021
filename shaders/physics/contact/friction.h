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
// anchor what a pass leaves of the slip adds up. Where friction slides, the stretch is that at which the soft constraint
// transmits its force (return mapping), so it can stick again at once. One and two points have no anchor: what rolls would swing
// on it.
#ifndef SCREE_PHYSICS_FRICTION_H
#define SCREE_PHYSICS_FRICTION_H

#include "shaders/physics/constraint/surface.h"
#include "shaders/physics/constraint/wrench.h"

LAWS_BEGIN

// Floor of the determinant of a matrix scaled to a trace of 1. Rounding can take all of it where a body is slender (seen from
// 1 : 200 on) or a lever arm many radii long. The impulse is then too great, and the friction limit bounds it.
CONSTANT float LEAST_DETERMINANT = 1.0e-12f;
CONSTANT float MAX_IMPULSE = 1.0e18f;  // N m s: the square is finite

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
    float inverse = reciprocal(larger(dot3(x, yz), LEAST_DETERMINANT));
    vec3 spin = (s.pair_velocity.b.angular - s.pair_velocity.a.angular) * unit;
    vec3 stopping = vec3(dot3(yz, spin), dot3(zx, spin), dot3(xy, spin)) * inverse;
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
        vec3 far = vec3(MAX_IMPULSE), step = flush_tiny(from - spin * reciprocal(greatest));
        after = choose(rolls, flush_tiny(shortened(larger3(-far, smaller3(far, step)), most)), after);
    }
    s.impulse.rolling = after;
    s.wrench.moment = s.wrench.moment + (after - before);
    s.pair_velocity.a.angular = s.pair_velocity.a.angular - turned_by(a, after - before) * a.split;
    s.pair_velocity.b.angular = s.pair_velocity.b.angular + turned_by(b, after - before) * b.split;
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

// B minus A at the centre of the patch, with the curvature of their paths, m/s. A ball that rolls does not touch where it did:
// its contact has no path.
LAW vec3 slip_of(Constraint c, LeverArms r, VelocityPair v, Parameters parameters) {
    vec3 slip = velocity_at(r, v), wa = v.a.angular, wb = v.b.angular;
    bool turns = point_count(c) > 1u && dot3(wa, wa) + dot3(wb, wb) > TURNING_SQUARED;
    if (!none(turns)) {
        // Bodies may spin beyond the limit within a pass, where the series diverges.
        vec3 curve_a = path_curvature(shortened(wa, parameters.max_spin), r.a, parameters.h);
        vec3 curve_b = path_curvature(shortened(wb, parameters.max_spin), r.b, parameters.h);
        slip = choose(turns, slip + (curve_b - curve_a), slip);
    }
    return slip;
}

// The anchor of a patch that sticks, in one pass: friction transmits -K^-1 (slip + rate * stretch), less `leak` of it.
struct Anchor {
    float rate;  // 1/s
    float leak;
    float give;  // leak / rate in the biased pass, s
};
LAW Anchor anchor_of_pass(Constraint c, bool biased, Parameters parameters) {
    // What touches in one or two points may roll, and a tyre has a compliance of its own.
    bool anchored = point_count(c) > 2u && !(c.tyre_slip > 0.0f);
    Anchor anchor;
    anchor.rate = choose(anchored && biased, parameters.bias_rate, 0.0f);
    anchor.leak = choose(anchored && biased, parameters.impulse_scale, 0.0f);
    anchor.give = choose(anchored, parameters.impulse_scale * reciprocal(parameters.bias_rate), 0.0f);
    return anchor;
}

// After the positions were integrated with `v`: the patch's stretch, which turns with the bodies as its friction does.
LAW Impulse stretched(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    vec3 slip = slip_of(c, lever_arms(c, c.centre, impulse.center_offset), v, parameters), wa = v.a.angular, wb = v.b.angular;
    bool driven = is_driven(c);
    if (!none(driven)) slip = choose(driven, slip + drive_of(c), slip);
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
    vec3 t1;
    float k11;
    vec3 t2;
    float k22;
    float k12, unit;
    float slip1, slip2;  // m/s, scaled
    float turn1, turn2;  // change of the spin by an impulse of 1 along either tangent, scaled
};
LAW FrictionBlock friction_block(LeverArms r, vec3 normal, Mass a, Mass b) {
    FrictionBlock k;
    k.t1 = tangent(normal);
    k.t2 = cross3(normal, k.t1);
    vec3 arm_a = cross3(r.a, k.t1), arm_b = cross3(r.b, k.t1);
    vec3 response_a = turned_by(a, arm_a) * a.split, response_b = turned_by(b, arm_b) * b.split;
    float linear = a.inverse_mass * a.split + b.inverse_mass * b.split;
    k.k11 = linear + (dot3(arm_a, response_a) + dot3(arm_b, response_b));
    k.turn1 = dot3(normal, response_a + response_b);
    arm_a = cross3(r.a, k.t2);
    arm_b = cross3(r.b, k.t2);
    k.k12 = dot3(arm_a, response_a) + dot3(arm_b, response_b);
    response_a = turned_by(a, arm_a) * a.split;
    response_b = turned_by(b, arm_b) * b.split;
    k.k22 = linear + (dot3(arm_a, response_a) + dot3(arm_b, response_b));
    k.turn2 = dot3(normal, response_a + response_b);
    k.unit = reciprocal(k.k11 + k.k22);
    k.k11 = k.k11 * k.unit;
    k.k22 = k.k22 * k.unit;
    k.k12 = k.k12 * k.unit;
    k.turn1 = k.turn1 * k.unit;
    k.turn2 = k.turn2 * k.unit;
    return k;
}
// Tyre compliance (tyre.h): slip + compliance * impulse = 0, in units of the effective mass.
LAW FrictionBlock with_compliance(FrictionBlock k, bool slips, float compliance, vec3 friction) {
    k.k11 = choose(slips, k.k11 + compliance, k.k11);
    k.k22 = choose(slips, k.k22 + compliance, k.k22);
    k.slip1 = choose(slips, k.slip1 + compliance * dot3(k.t1, friction), k.slip1);
    k.slip2 = choose(slips, k.slip2 + compliance * dot3(k.t2, friction), k.slip2);
    return k;
}

struct PatchImpulse {
    vec3 friction;
    float twist;
};
// The impulse of a patch that slides or spins: a step of projected gradient descent from `before`. `spin` and
// `spin_mass` (rad/s; 1 / (kg m^2), 0 without torsional friction) are scaled as the block; F's terms by arm^2. `resists`:
// the impulse is on the surface at once. A step of spin on an arm that is short beside the body is a small part of the
// limit, and spinning resistance would act like a viscous one. It stops the spin at most, `stopping`: on an arm of many radii the
// limit would reverse it.
LAW PatchImpulse slid(FrictionBlock k, PatchImpulse before, float spin, float spin_mass, float arm, float hold, bool resists,
                      float stopping) {
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
    after.friction = flush_tiny(before.friction - (k.t1 * k.slip1 + k.t2 * k.slip2) * (q * step));
    after.twist = flush_tiny(before.twist - spin * (p * step));
    // Bounded, for a contact that has all but let go: the square of its quotient leaves the range of a float.
    vec3 quotient = after.friction * hold;
    float turned = after.twist * hold, squared = smaller(p * dot3(quotient, quotient) + q * turned * turned, 1.0e30f);
    float scale = bound * inverse_square_root(larger(squared, 1.0e-30f) * bound);
    scale = choose(resists || squared > bound, scale, 1.0f);
    after.friction = flush_tiny(after.friction * scale);
    after.twist = flush_tiny(after.twist * scale);
    float stopped = before.twist + stopping;
    bool reverses = resists && abs(after.twist) > abs(stopped) && (after.twist - stopped) * stopping >= 0.0f;
    after.twist = choose(reverses, flush_tiny(stopped), after.twist);
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
    LeverArms r = lever_arms(c, c.centre, s.impulse.center_offset);
    FrictionBlock k = friction_block(r, c.normal, a, b);
    float spin = 0.0f, spin_mass = 0.0f, stopping = 0.0f;
    if (!none(twists)) {
        spin = choose(twists, dot3(c.normal, v.b.angular - v.a.angular), 0.0f);
        spin_mass = dot3(c.normal, turned_by(a, c.normal)) * a.split + dot3(c.normal, turned_by(b, c.normal)) * b.split;
        stopping = (spin + anchor.rate * s.impulse.turn) * reciprocal(spin_mass);
        stopping = choose(holds, -stopping - anchor.leak * before.twist, -before.twist);
        stopping = choose(twists, stopping, 0.0f);  // in lanes beside ones that do
        spin_mass = choose(twists, spin_mass, 0.0f);
        after.twist = choose(twists, flush_tiny(before.twist + stopping), before.twist);
    }
    vec3 slip = slip_of(c, r, v, parameters) * k.unit;
    k.slip1 = dot3(k.t1, slip);
    k.slip2 = dot3(k.t2, slip);
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
    float inverse = reciprocal(larger(k.k11 * k.k22 - k.k12 * k.k12, LEAST_DETERMINANT));
    float bias = anchor.rate * k.unit;
    float slip1 = k.slip1 + k.turn1 * stopping + bias * dot3(k.t1, s.impulse.stretch);
    float slip2 = k.slip2 + k.turn2 * stopping + bias * dot3(k.t2, s.impulse.stretch);
    vec3 stop = k.t1 * ((k.k22 * slip1 - k.k12 * slip2) * inverse) + k.t2 * ((k.k11 * slip2 - k.k12 * slip1) * inverse);
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
        bool resists = (c.flags & CONSTRAINT_ROLLS_ONLY) != 0u && !(anchor.give > 0.0f);  // spinning, with its own arm
        PatchImpulse sliding = slid(k, before, spin * k.unit, spin_mass * k.unit, arm, hold, resists, stopping);
        after.friction = choose(slides, sliding.friction, after.friction);
        after.twist = choose(slides && twists, sliding.twist, after.twist);
    }
    // A patch that slides keeps the stretch at which the soft constraint transmits its friction: it can stick at once.
    if (!none(slides)) {
        float f1 = dot3(k.t1, after.friction), f2 = dot3(k.t2, after.friction);
        float scale = anchor.give * reciprocal(k.unit);
        vec3 stretch = k.t1 * (k.k11 * f1 + k.k12 * f2) + k.t2 * (k.k12 * f1 + k.k22 * f2);
        s.impulse.stretch = choose(slides, stretch * -scale, s.impulse.stretch);
        s.impulse.turn = choose(slides, -anchor.give * spin_mass * after.twist, s.impulse.turn);
    }
    bool anchored = holds && anchor.give > 0.0f;
    s.impulse.stretch = choose(anchored, flush_tiny(s.impulse.stretch), vec3(0.0f));
    s.impulse.turn = choose(anchored, flush_tiny(s.impulse.turn), 0.0f);
    s.impulse.friction = after.friction;
    s.impulse.twist = after.twist;
    Wrench change;
    change.push = after.friction - before.friction;
    change.moment = c.normal * (after.twist - before.twist);
    s.wrench = plus(s.wrench, change);
    s.pair_velocity = exerted(v, change, r, a, b);
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
    t.wrench.push = choose(condition, s.wrench.push, t.wrench.push);
    t.wrench.moment = choose(condition, s.wrench.moment, t.wrench.moment);
    return t;
}
LAW bool has_friction(Impulse impulse) {
    vec3 f = impulse.friction, r = impulse.rolling;
    return f.x != 0.0f || f.y != 0.0f || f.z != 0.0f || impulse.twist != 0.0f || r.x != 0.0f || r.y != 0.0f || r.z != 0.0f;
}

// Whether the relax pass, which changes normal impulses by `press` (press_at) to `normal`, solves friction anew: where it bears
// more than the one part of its limit, or the load has changed by more than the other. (A patch that sticks under a steady load
// is at rest after the biased pass.)
CONSTANT float NEAR_LIMIT = 0.64f;  // squared
CONSTANT float CHANGED = 0.02f;
LAW bool needs_friction_again(Constraint c, Impulse impulse, vec3 press, float normal) {
    float hold = reciprocal(larger(c.friction * normal, LEAST_HOLD));
    vec3 held = impulse.friction * hold;
    float arm = choose(c.twist_arm > 0.0f, c.twist_arm, 1.0f), area = arm * arm, turned = impulse.twist * hold;
    bool may_slide = dot3(held, held) * area + smaller(turned * turned, 1.0e30f) > NEAR_LIMIT * area;
    float change = larger(abs(press.x) * arm, larger(abs(press.y), abs(press.z)));
    return may_slide || change > CHANGED * normal * arm || c.rolling_resistance > 0.0f;
}

// Both passes solve rolling resistance, on the masses as they are split, `a` and `b`; friction on `relaxed_a` and `relaxed_b`.
LAW SolveResult solve_patch_friction(Constraint c, SolveResult s, float normal, Mass a, Mass b, Mass relaxed_a, Mass relaxed_b,
                                     bool biased, Parameters parameters) {
    bool acts = normal != 0.0f || has_friction(s.impulse);
    if (none(acts)) return s;
    bool resists = acts && c.rolling_resistance != 0.0f;
    SolveResult after = s;
    if (!none(resists)) after = choose(resists, solve_rolling(c, s, normal, a, b), s);
    after = solve_friction(c, after, normal, relaxed_a, relaxed_b, biased, parameters);
    if (none(!acts)) return after;
    return choose(acts, after, s);
}

LAWS_END

#endif
