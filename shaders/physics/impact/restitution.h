// Restitution by energy: an impact returns e^2 of the work that its compression took (W. J. Stronge, Rigid body collisions
// with friction, Proc. R. Soc. A 431, 1990).
//
// The biased pass of the substep in which bodies meet is the compression. The relax pass of the same substep, not one after
// the last substep, is the restitution: a bounce loses no part of a step's flight (g dt / v of its energy, 3% at 5 m/s and
// 60 Hz), and an impact propagates through a row of balls. The points of a contact are pushed apart in proportion to their
// impulses of compression (Poisson's hypothesis), as much as the energy asks.
//
// Impulses that act at the same time do work by the mean of the velocities before and after, exactly, whatever else acts on
// the bodies. So the account of each impact is exact, and the energy of several impacts is the sum of theirs. In the
// restitution a struck body is split among its impacts alone (mass splitting; with the usual over-relaxed split its
// resting contacts would absorb part of the rebound). The whole bodies never gain more than the split ones, so two impacts
// at once, or one on a body that passes the impulse on through joints, return only a part: what is left is returned in the
// next substeps, and in the next step (settled_impact, rebounds_across).
//
// Of two impacts along nearly parallel normals one may return more than its energy, because the other pushed the body as
// well. What is too much is its debt, which the other impacts of its bodies return less.
//
// Symplectic Euler substeps (v += g h, x += v h) put positions exactly on a parabola whose speed is v + g h / 2 on the
// way down and v - g h / 2 on the way up: e times v alone would lose g h of the speed in every bounce (1% of the height
// from 1 m at 480 Hz). So the impact velocity is that of the parabola where it meets the surface, and the rebound is
// corrected alike.
#ifndef SCREE_PHYSICS_RESTITUTION_H
#define SCREE_PHYSICS_RESTITUTION_H

#include "shaders/physics/constraint/normal_rows.h"
#include "shaders/physics/impact/impact_state.h"

LAWS_BEGIN

// Gauss-Seidel sweeps over the points of a contact in the compression of an impact: what falls flat leaves without a spin.
CONSTANT int IMPACT_SWEEPS = 8;

// A point that bears less than this part of the impulse that would stop it is struck; one that bears more is in resting
// contact.
CONSTANT float IMPACT_DISTANCE = 0.01f;

// Slower approaches have no restitution, m/s: what rests on a surface approaches at up to the speed of a fall in two
// steps, and bodies beside each other do not.
LAW float slowest_impact(Constraint c, ImpactContext around, Parameters parameters) {
    float pull = larger(abs(dot3(c.normal, parameters.gravity)), abs(dot3(c.normal, around.acceleration)));
    float threshold = choose(c.restitution_threshold > 0.0f, c.restitution_threshold, parameters.restitution_threshold);
    return larger(threshold, 2.0f * parameters.dt * pull);
}

// An impact ends when it has returned its energy but for this part.
CONSTANT float REBOUND_LEFT = 1.0e-3f;

// Rebound velocity without geometry, m/s: e times the impact velocity, less half a substep's relative acceleration.
LAW float plain_rebound(Constraint c, float impact_velocity, float pull, Parameters parameters) {
    return positive(-(c.restitution * impact_velocity + 0.5f * parameters.h * pull));
}

LAW bool is_impact(Impulse impulse) {
    vec4 a = impulse.impact;
    return a.x > 0.0f || a.y > 0.0f || a.z > 0.0f || a.w > 0.0f;
}

// What the last push did of an impact on joints. It acted on one body of the assembly, whose others took their part through
// the joints afterwards: the speed of the contact went from `from` to `to`, m/s. As long as the bodies approached that was
// compression, of which the impact returns e^2, then it was expansion. And the change of speed tells on what mass the assembly
// answers: with that mass the next push does what is left, whatever hangs on the struck body.
struct JoinedPush {
    float energy;    // that is left to return, J
    float response;  // change of speed by an impulse of 1, 1/kg
};
LAW JoinedPush joined_push(float pushed, float from, float to, float energy, float e2) {
    JoinedPush push;
    float gained = to - from;
    float mean = 0.5f * (pushed * reciprocal(larger(gained, 1.0e-6f)));
    float low_from = smaller(from, 0.0f), low_to = smaller(to, 0.0f), high_from = positive(from), high_to = positive(to);
    float compression = positive(mean * (low_from * low_from - low_to * low_to));
    float expansion = positive(mean * (high_to * high_to - high_from * high_from));
    push.energy = flush_least((energy + e2 * compression) - expansion);
    push.response = choose(gained > 0.0f, gained * reciprocal(larger(pushed, 1.0e-18f)), 1.0e30f);
    return push;
}
// On how much more than the mass of the struck bodies the next push may act.
CONSTANT float LEAST_RESPONSE = 0.0625f;

// As a substep begins: what an impact of the last one has yet to return, by the velocities that it reached.
LAW Impulse impact_in_progress(Constraint c, Impulse impulse, vec3 speeds, ImpactContext around, Parameters parameters) {
    float gain = parameters.h * dot3(c.normal, around.acceleration);  // by gravity since
    float work = 0.0f;
    for (int k = 0; k < 4; ++k) {
        bool struck = uint(k) < point_count(c) && impulse.impact[k] > 0.0f;
        if (none(struck)) continue;
        float reached = speed_at(c, speeds, k) - gain;
        work = choose(struck, work + 0.5f * (impulse.impact[k] * reached), work);
    }
    float before = impulse.rebound_energy;
    float left = flush_least(before - work);
    bool joined = impulse.impact_energy > 0.0f && impulse.speed_before_push != 0.0f;
    float response = 0.0f;
    if (!none(joined)) {
        float pushed = (impulse.impact.x + impulse.impact.y) + (impulse.impact.z + impulse.impact.w);
        float reached = 2.0f * (work * reciprocal(larger(pushed, 1.0e-18f)));
        JoinedPush push = joined_push(pushed, impulse.speed_before_push, reached, before, c.restitution * c.restitution);
        left = choose(joined, push.energy, left);
        response = push.response;
    }
    bool lasted = is_impact(impulse) && impulse.impact_energy > 0.0f;
    bool lasts = lasted && left > REBOUND_LEFT * impulse.impact_energy;
    float weight = choose(left < before, square_root(positive(left * reciprocal(larger(before, left)))), 1.0f);
    impulse.impact = choose(lasts, impulse.impact, vec4(0.0f));
    impulse.rebound_energy = choose(lasts, left, choose(lasted, smaller(left, 0.0f), 0.0f));
    impulse.impact_energy = choose(lasts, impulse.impact_energy, 0.0f);
    impulse.impact_weight =
        choose(lasts, weight * ((impulse.impact.x + impulse.impact.y) + (impulse.impact.z + impulse.impact.w)), 0.0f);
    impulse.flight_energy = 0.0f;
    impulse.speed_before_push = 0.0f;
    impulse.response = choose(lasts && joined, response, 0.0f);
    return impulse;
}

// Normal velocities at which points strike, m/s, < 0; 0 for those that do not rebound. Measured before any point is
// solved, because solving one turns the bodies at the others. The surface is met after a part of the substep.
LAW vec4 impact_velocities(Constraint c, Impulse impulse, vec3 speeds, NormalRows rows, ImpactContext around,
                           Parameters parameters) {
    vec4 found = vec4(0.0f);
    float gain = parameters.h * dot3(c.normal, around.acceleration);
    float slowest = slowest_impact(c, around, parameters);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) continue;
        float speed = speed_at(c, speeds, k);
        float way = parameters.h * speed;
        float mass = reciprocal(speed_at(c, response_at(rows, c, k), k));
        bool strikes = impulse.normal[k] <= -IMPACT_DISTANCE * mass * speed;
        bool meets = there && strikes && speed < -slowest && impulse.separation[k] + way < 0.0f;
        if (none(meets)) continue;
        float part = choose(impulse.separation[k] > 0.0f, -impulse.separation[k] * reciprocal(way), 0.0f);
        // Clamped: accelerations that exceed the speed itself within one substep are beyond this model.
        found[k] = choose(meets, smaller(speed + gain * (part - 0.5f), 0.5f * speed), found[k]);
    }
    return found;
}

// Energy that an impact which has ended returned too much, J.
LAW float impact_debt(Impulse impulse) {
    return choose(is_impact(impulse), 0.0f, positive(-impulse.rebound_energy));
}

// The impact of `impact` where `condition` holds, else none.
LAW Impulse with_impact(Impulse impulse, Impulse impact, bool condition) {
    impulse.impact = choose(condition, impact.impact, vec4(0.0f));
    impulse.rebound_energy = choose(condition, impact.rebound_energy, 0.0f);
    impulse.impact_energy = choose(condition, impact.impact_energy, 0.0f);
    impulse.impact_weight = choose(condition, impact.impact_weight, 0.0f);
    impulse.flight_energy = choose(condition, impact.flight_energy, 0.0f);
    impulse.speed_before_push = choose(condition, impact.speed_before_push, 0.0f);
    impulse.response = choose(condition, impact.response, 0.0f);
    return impulse;
}

LAW bool is_any(vec4 striking) {
    return striking.x < 0.0f || striking.y < 0.0f || striking.z < 0.0f || striking.w < 0.0f;
}

// Bound of the mass on which a point's impulse acts, of the point's own effective mass; the points of a face that strikes at
// once have up to twice their own. Where other points turn the body against it a point changes its velocity by almost nothing,
// and the quotient has no bound.
CONSTANT float MOST_STRUCK_MASS = 4.0f;

// After the biased pass: the points that struck, and of the energy to return what is known so far. The compression impulse
// p does the work p (v + u) / 2 from velocity v to u; u is known when all contacts have been solved (with_restitution). With
// the rebound w that a single point would have, and the mass m on which it acts, m (w^2 - e^2 v^2) / 2 is what gravity adds
// in the part of the substep that is flight: to the body, so that several impacts share it.
LAW Impulse after_compression(Constraint c, Impulse impulse, vec4 striking, vec4 normal_before, vec3 before, vec3 after,
                              NormalRows rows, Mass a, Mass b, ImpactContext around, Parameters parameters) {
    float e2 = c.restitution * c.restitution;
    float pull = dot3(c.normal, around.acceleration);
    float whole = larger(a.split, b.split);
    float flights = 0.0f;
    // What presses again without a new impact, and would not rebound faster than from the slowest one, comes to rest: only
    // what is no impact is warm started.
    bool rests = false;
    for (int k = 0; k < 4; ++k)
        rests = rests || (impulse.impact[k] > 0.0f && striking[k] == 0.0f && impulse.normal[k] > normal_before[k]);
    float pushed_by = (impulse.impact.x + impulse.impact.y) + (impulse.impact.z + impulse.impact.w);
    rests = rests && impulse.rebound_energy < 0.5f * (pushed_by * slowest_impact(c, around, parameters));
    impulse = with_impact(impulse, impulse, !rests);
    for (int k = 0; k < 4; ++k) {
        float pressed = impulse.normal[k] - normal_before[k];
        bool struck = (striking[k] < 0.0f || impulse.impact[k] > 0.0f) && pressed > 0.0f;
        if (none(struck)) continue;
        float reached = speed_at(c, after, k), speed = speed_at(c, before, k);
        float strike = choose(striking[k] < 0.0f, striking[k], speed);
        // Clamped: a speculative impulse may change almost nothing, and then rounding decides.
        float rise = larger(larger(reached - speed, 1.0e-4f * abs(speed)), 1.0e-9f);
        float wanted = plain_rebound(c, strike, pull, parameters);
        float own_mass = reciprocal(speed_at(c, response_at(rows, c, k), k));
        float mass = smaller(pressed * reciprocal(rise), MOST_STRUCK_MASS * own_mass);
        float flight = whole * (mass * (wanted * wanted - e2 * (speed * speed)));
        flights = choose(struck, flights + 0.5f * flight, flights);
        impulse.rebound_energy = choose(struck, impulse.rebound_energy - 0.5f * (pressed * (e2 * speed)), impulse.rebound_energy);
        impulse.impact_weight = choose(struck, impulse.impact_weight + (pressed + mass * wanted), impulse.impact_weight);
        impulse.impact[k] = choose(struck, impulse.impact[k] + pressed, impulse.impact[k]);
    }
    impulse.impact = flush_tiny(impulse.impact);
    impulse.impact_weight = flush_tiny(impulse.impact_weight);
    impulse.rebound_energy = flush_least(impulse.rebound_energy);
    impulse.flight_energy = flush_least(flights);
    return impulse;
}

// The mode in which the points of an impact are pushed apart: `share` of a unit impulse at each of them.
struct ImpactMode {
    vec4 share;
    float speed;                   // of the pair along the mode, m/s
    float inverse_effective_mass;  // of the split pair, 1/kg
};
LAW ImpactMode impact_mode(Constraint c, Impulse impulse, vec3 speeds, NormalRows rows) {
    ImpactMode mode;
    mode.share = impulse.impact;
    float sum = (mode.share.x + mode.share.y) + (mode.share.z + mode.share.w);
    mode.share = mode.share * reciprocal(larger(sum, 1.0e-18f));
    vec3 press = vec3(0.0f);
    for (int k = 0; k < 4; ++k) press = press + press_at(c, mode.share[k], k);
    mode.speed = dot3(press, speeds);
    mode.inverse_effective_mass = larger(dot3(press, response_to(rows, press)), 1.0e-30f);
    return mode;
}

LAW ImpactMode of_assembly(ImpactMode mode, float response, bool answered) {
    float own = mode.inverse_effective_mass;
    mode.inverse_effective_mass = choose(answered, clamped(response, LEAST_RESPONSE * own, own), own);
    return mode;
}

// The half of a rotation by w h as an unnormalised quaternion: for the body that rotated, back.
LAW vec4 turned_back(vec3 angular, float h) {
    vec3 half_turn = angular * (-0.5f * h);
    return unit_quaternion(vec4(half_turn * (1.0f + 0.33333333f * dot3(half_turn, half_turn)), 1.0f));
}
// The angular velocity before the substep's free motion, which ends with `angular`: gyroscopic torque changed it while the
// angular momentum L stayed (explicit midpoint, backwards). Of inertia only ratios matter: the tensor is scaled to trace 1.
LAW vec3 angular_before_motion(vec3 angular, Mass mass, float h) {
    bool evenly = mass.xx == mass.yy && mass.xx == mass.zz && mass.xy == 0.0f && mass.xz == 0.0f && mass.yz == 0.0f;
    if (none(!evenly)) return angular;
    float scale = reciprocal(larger((mass.xx + mass.yy) + mass.zz, 1.0e-30f));
    Mass m = mass;
    m.xx = mass.xx * scale;
    m.yy = mass.yy * scale;
    m.zz = mass.zz * scale;
    m.xy = mass.xy * scale;
    m.xz = mass.xz * scale;
    m.yz = mass.yz * scale;
    Mass cofactors = m;
    cofactors.xx = m.yy * m.zz - m.yz * m.yz;
    cofactors.yy = m.xx * m.zz - m.xz * m.xz;
    cofactors.zz = m.xx * m.yy - m.xy * m.xy;
    cofactors.xy = m.xz * m.yz - m.xy * m.zz;
    cofactors.xz = m.xy * m.yz - m.xz * m.yy;
    cofactors.yz = m.xy * m.xz - m.yz * m.xx;
    float determinant = (m.xx * cofactors.xx + m.xy * cofactors.xy) + m.xz * cofactors.xz;
    vec3 momentum = turned_by(cofactors, angular) * reciprocal(larger(determinant, 1.0e-18f));
    vec4 back = turned_back(angular, 0.5f * h);
    vec3 halfway = rotate(back, turned_by(m, rotate_back(back, momentum)));
    back = turned_back(halfway, h);
    vec3 before = angular + (rotate(back, turned_by(m, rotate_back(back, momentum))) - turned_by(m, momentum));
    return choose(evenly, angular, before);
}
LAW VelocityPair before_motion(VelocityPair v, Mass a, Mass b, float h) {
    v.a.angular = angular_before_motion(v.a.angular, a, h);
    v.b.angular = angular_before_motion(v.b.angular, b, h);
    return v;
}

// The relax pass of the struck points: the impulse along the mode that does the work which is left. `met`, `met_rows` and
// `reached` are the constraint, the rows and the speeds of the biased pass, which did its work along that
// normal: the bodies have moved since, and normal, lever arms and angular velocities with them.
LAW Impulse with_restitution(Constraint met, NormalRows met_rows, vec3 reached, Constraint c, Impulse impulse, NormalRows rows,
                             vec3 speeds, Mass a, Mass b, ImpactContext around) {
    float e2 = c.restitution * c.restitution;
    float pressed = 0.0f, work = 0.0f;
    for (int k = 0; k < 4; ++k) {
        bool struck = impulse.impact[k] > 0.0f;
        pressed = choose(struck, pressed + impulse.normal[k], pressed);
        work = choose(struck, work + 0.5f * (impulse.normal[k] * speed_at(met, reached, k)), work);
    }
    // An approach that is left, or a speed of the push-out, is energy of the compression as well.
    ImpactMode before = impact_mode(met, impulse, reached, met_rows);
    bool joined = around.on_joints, answered = joined && impulse.impact_energy > 0.0f;
    if (!none(answered)) before = of_assembly(before, impulse.response, answered);
    float rest = 0.5f * ((before.speed * before.speed) * reciprocal(before.inverse_effective_mass));
    bool compressed = pressed > 0.0f || before.speed < 0.0f;
    float flight = choose(answered, 0.0f, impulse.flight_energy * reciprocal(larger(a.split, b.split)));
    float stored = impulse.rebound_energy - around.debt + flight - e2 * work;
    float energy = stored - choose(compressed, (1.0f - e2) * rest, 0.0f);

    ImpactMode mode = impact_mode(c, impulse, speeds, rows);
    if (!none(answered)) mode = of_assembly(mode, impulse.response, answered);
    float squared = mode.speed * mode.speed + 2.0f * (energy * mode.inverse_effective_mass);
    float push = (square_root(positive(squared)) - mode.speed) * reciprocal(mode.inverse_effective_mass);
    vec4 normal = impulse.normal;
    float done = 0.0f;
    for (int k = 0; k < 4; ++k) {
        bool struck = impulse.impact[k] > 0.0f;
        float now = positive(flush_tiny(normal[k] + push * mode.share[k]));
        float change = now - normal[k];
        done = choose(struck, done + 0.5f * (change * speed_at(c, speeds, k)), done);
        normal[k] = choose(struck, now, normal[k]);
    }
    // Where all else stays as it is, the work is done at once.
    bool passes_on = around.on_joints || larger(a.split, b.split) > 1.001f;
    bool lasts = passes_on && push > 0.0f && (energy > 0.0f || (joined && squared > 0.0f));
    for (int k = 0; k < 4; ++k) {
        bool struck = impulse.impact[k] > 0.0f;
        float change = flush_tiny(normal[k] - impulse.normal[k]);
        impulse.impact[k] = choose(struck && lasts, change, impulse.impact[k]);
        impulse.normal[k] = choose(struck, normal[k], impulse.normal[k]);
    }
    float to_return = choose(joined, stored + e2 * rest, energy);
    impulse.impact_energy = choose(lasts, larger(impulse.impact_energy, flush_least(to_return)), 0.0f);
    impulse.rebound_energy = choose(lasts, flush_least(choose(joined, stored, energy - done)), 0.0f);
    float from = choose(mode.speed == 0.0f, -1.0e-9f, mode.speed);
    impulse.flight_energy = 0.0f;
    impulse.speed_before_push = choose(lasts && joined, from, 0.0f);
    impulse.response = 0.0f;
    return impulse;
}

// The split mass in the relax pass: a struck body is split among its impacts by their weights.
LAW Mass impact_mass(Impulse impulse, BodyMass body, BodyForces load, Parameters parameters) {
    Mass mass = split_mass(body, impulse, parameters);
    float split = load.impact_weight * reciprocal(larger(impulse.impact_weight, 1.0e-18f));
    mass.split = choose(is_impact(impulse), larger(1.0f, split), mass.split);
    return mass;
}

// The contact's part of its bodies' debts, J: the impacts of a body share them as they share its mass.
LAW float part_of_debts(Impulse impulse, float debt_a, BodyForces load_a, Mass a, float debt_b, BodyForces load_b, Mass b) {
    debt_a = choose(load_a.impact_weight != 0.0f, debt_a * reciprocal(a.split), 0.0f);
    debt_b = choose(load_b.impact_weight != 0.0f, debt_b * reciprocal(b.split), 0.0f);
    return choose(is_impact(impulse), debt_a + debt_b, 0.0f);
}

// Removes the impulses of impacts, which must not warm start the next substep, and debts, which the bodies have.
LAW Impulse clear_impacts(Impulse impulse, uint count) {
    bool blow = false, lasts = impulse.impact_energy > 0.0f;
    float normal = 0.0f;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < count;
        if (none(there)) break;
        bool struck = there && impulse.impact[k] > 0.0f;
        impulse.normal[k] = choose(struck, 0.0f, impulse.normal[k]);
        impulse.impact[k] = choose(lasts, impulse.impact[k], 0.0f);
        blow = blow || struck;
        normal = choose(there, normal + impulse.normal[k], normal);
    }
    impulse.rebound_energy = choose(lasts, impulse.rebound_energy, 0.0f);
    bool spent = blow && normal == 0.0f;
    impulse.friction = choose(spent, vec3(0.0f), impulse.friction);
    impulse.twist = choose(spent, 0.0f, impulse.twist);
    impulse.rolling = choose(spent, vec3(0.0f), impulse.rolling);
    impulse.stretch = choose(spent, vec3(0.0f), impulse.stretch);
    impulse.turn = choose(spent, 0.0f, impulse.turn);
    return impulse;
}

LAWS_END

#endif
