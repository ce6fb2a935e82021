// Contact constraint solver: each contact is one block of a mass-splitting Jacobi iteration.
//
// Mass splitting (Tonge, Benevolenski, Voroshilov, Mass Splitting for Jitter-Free Parallel Rigid Body Simulation,
// SIGGRAPH 2012): a body in n contacts is split into one body of mass m/s for each, s = max(1, n/1.5) if their normal
// impulses are equal (mass_splitting.h). A contact solves its points by Gauss-Seidel on its two split bodies, and each
// whole body receives 1/s of its split body's velocity change. So contacts are independent, momentum is exact, the
// order of contacts means nothing, and the iteration converges (s = n/omega with omega < 2 is over-relaxed Jacobi on
// the split masses). n counts only active contacts, which bore in the biased pass or come near in the next substep: a ball
// about to be struck shares no mass with the neighbour that it merely lies beside.
//
// Soft constraints (Catto, Soft Constraints, GDC 2011; Solver2D, 2024): penetration is a damped spring, solved
// implicitly with the split mass. A substep solves with bias, integrates positions, and relaxes without bias, which
// takes the spring's velocity out again. Restitution acts in the relax pass (restitution.h).
//
// Both bodies receive an impulse at the same point while they move through the substeps: the lever arm on the anchor
// body is fixed, the other follows from the present offset d between the centres, so angular momentum is exact to
// rounding. A contact ends within the step once its bodies have slid along the surface by more than the half width of
// the body slid over: its points would hang in the air, so it pushes no more until the next narrowphase.
//
// The contacts of one pair of bodies are one block (contact_block.h).
#ifndef SCREE_PHYSICS_CONTACT_SOLVER_H
#define SCREE_PHYSICS_CONTACT_SOLVER_H

#include "shaders/physics/body/mass_splitting.h"
#include "shaders/physics/constraint/normal_rows.h"
#include "shaders/physics/constraint/wrench.h"
#include "shaders/physics/contact/friction.h"
#include "shaders/physics/impact/restitution.h"

LAWS_BEGIN

LAW float round_gap(Constraint c, vec3 d) {
    return length3((d + c.centre) - round_centre_of_a(c)) - (c.radius_a + c.radius_b);
}
// The constraint at the present poses: between two round bodies, normal and point follow the centres of curvature.
LAW Constraint refresh_round_contact(Constraint c, vec3 d) {
    bool follows = is_of_round_bodies(c);
    if (none(follows)) return c;
    vec3 core = round_centre_of_a(c);
    bool driven = follows && is_driven(c);
    vec3 drive = vec3(0.0f);
    if (!none(driven)) drive = drive_of(c);
    c.normal = choose(follows, unit3((d + c.centre) - core, c.normal), c.normal);
    c.centre = choose(follows, core + c.normal * (c.radius_a + 0.5f * round_gap(c, d)), c.centre);
    c.points_u = choose(follows, vec4(0.0f), c.points_u);
    if (!none(driven)) c = choose_drive(driven, with_drive(c, drive), c);
    c.flags = choose(follows, c.flags & ~CONSTRAINT_ROUND, c.flags);
    return c;
}

// Several points that approach faster than what gravity adds to a speed in so many substeps are solved in sweeps: a single sweep
// would leave what falls flat with a spin. Where nothing else bears the bodies, also if they part so fast: the impulses of a blow
// throw them apart as the next substep begins. (Sweeps on other contacts double the rise of what falls upon columns.)
CONSTANT float ARRIVAL = 4.0f;
LAW bool is_fast(float speed, Parameters parameters) {
    return speed > ARRIVAL * fall_speed(parameters);
}
LAW uint sweeps_of(Constraint c, vec3 speeds, Mass a, Mass b, Parameters parameters) {
    float speed = choose(larger(a.split, b.split) > 1.0f, -speeds.x, abs(speeds.x));
    return choose(point_count(c) > 1u && is_fast(speed, parameters), uint(IMPACT_SWEEPS), 1u);
}
// Shares of the mass for another relaxation of the iteration. In the biased pass over-relaxed shares overshoot along the normal,
// and the relax pass takes that back. What a single pass solves may not overshoot.
LAW Mass with_relaxation(Mass mass, bool condition, float relaxation, Parameters parameters) {
    float split = mass.split * reciprocal(parameters.inverse_relaxation * relaxation);
    mass.split = choose(condition && mass.split > 1.0f, split, mass.split);
    return mass;
}
// Most friction is solved in the biased pass alone: with a relaxation of w the error of its warm start changes in a substep by
// 1 - w +- sqrt(w^2 - w), so it grows above 4/3.
CONSTANT float FRICTION_RELAXATION = 0.8f;
// `struck`: in an impact, which nothing corrects afterwards.
LAW SolveResult solve_relaxed_friction(Constraint c, SolveResult s, float normal, Mass a, Mass b, bool struck, bool biased,
                                       Parameters parameters) {
    return solve_patch_friction(c, s, normal, a, b, with_relaxation(a, !struck, FRICTION_RELAXATION, parameters),
                                with_relaxation(b, !struck, FRICTION_RELAXATION, parameters), biased, parameters);
}

// The biased pass: normal impulses of soft constraints, or speculative ones (no bias, up to contact) where the bodies
// are still apart. `part`: part_of_stiffness() of its block, 1 for a contact by itself.
LAW SolveResult solve_contact(Constraint c, Impulse impulse, VelocityPair v, Mass a, Mass b, ImpactContext around, float part,
                              Parameters parameters) {
    c = refresh_round_contact(c, impulse.center_offset);
    bool gone = impulse.slide_distance > c.slide_limit;
    // Push-out speed, divided by the split factor because the pushes of overlapping neighbours add up from layer to
    // layer. At most by 4: a tray under hundreds of boxes must still bear them.
    float push_speed = parameters.push_speed * reciprocal(smaller(4.0f, larger(a.split, b.split)));
    NormalRows rows = normal_rows(c, impulse.center_offset, a, b);
    vec3 speeds = normal_speeds(c, impulse.center_offset, v), speeds_before = speeds;
    bool bounces = c.restitution > 0.0f && !around.under_blow;
    vec4 striking = vec4(0.0f);
    if (none(bounces)) {
        impulse = with_impact(impulse, impulse, false);  // also of an impact that lasts while restitution is taken away
    } else {
        impulse = with_impact(impulse, impact_in_progress(c, impulse, speeds, around, parameters), bounces && !gone);
        striking = choose(bounces, impact_velocities(c, impulse, speeds, rows, around, parameters), vec4(0.0f));
    }
    bool strikes = is_any(striking);
    vec4 normal_before = impulse.normal;
    vec3 press = vec3(0.0f);
    uint sweeps = choose(strikes && point_count(c) > 1u, uint(IMPACT_SWEEPS), sweeps_of(c, speeds, a, b, parameters));
    int sweep = 0;
    do {
        for (int k = 0; k < 4; ++k) {
            bool there = uint(sweep) < sweeps && uint(k) < point_count(c);
            if (none(there)) break;
            float speed = speed_at(c, speeds, k);
            float separation = impulse.separation[k];
            float before = impulse.normal[k];
            float bias = larger(parameters.mass_scale * parameters.bias_rate * separation, -push_speed);
            float excess =
                choose(separation > 0.0f, speed + separation * parameters.inverse_h, parameters.mass_scale * speed + bias);
            bool acts = there && !(before == 0.0f && (gone || excess >= 0.0f));
            if (none(acts)) continue;  // a third of all contacts are speculative and inactive
            vec3 response = response_at(rows, c, k);
            float change = -reciprocal(speed_at(c, response, k)) * excess;
            change = choose(separation <= 0.0f, part * change - parameters.impulse_scale * before, change);
            float after = choose(acts, choose(gone, 0.0f, positive(flush_tiny(before + change))), before);
            impulse.normal[k] = after;
            speeds = speeds + response * (after - before);
            press = press + press_at(c, after - before, k);
        }
        ++sweep;
    } while (!none(uint(sweep) < sweeps));
    SolveResult result = result_of(c, impulse, speeds, press);
    if (!none(strikes || is_impact(impulse)))
        result.impulse =
            after_compression(c, impulse, striking, normal_before, speeds_before, speeds, rows, a, b, around, parameters);
    result.pair_velocity = exerted(v, result.wrench, lever_arms(c, c.centre, impulse.center_offset), a, b);
    return solve_relaxed_friction(c, result, normal_impulse(impulse), a, b, false, true, parameters);
}

// After the positions were integrated with `moved`: the separations, the offset between the centres and the way of the slide,
// from where the bodies meet: what comes down at a slant has its contact when it touches.
LAW Impulse after_motion(Constraint c, Impulse impulse, VelocityPair moved, Parameters parameters) {
    bool follows = is_of_round_bodies(c), meets = false;
    vec3 speeds = normal_speeds(c, impulse.center_offset, moved);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c) && !follows;
        if (none(there)) break;
        float separation = impulse.separation[k] + parameters.h * speed_at(c, speeds, k);
        impulse.separation[k] = choose(there, separation, impulse.separation[k]);
        meets = meets || (there && separation <= 0.0f);
    }
    vec3 way = (moved.b.linear - moved.a.linear) * parameters.h;
    impulse.center_offset = impulse.center_offset + way;
    float slide = length3(way - c.normal * dot3(way, c.normal));
    impulse.slide_distance = impulse.slide_distance + choose(meets, slide, 0.0f);
    if (!none(follows)) impulse.separation.x = choose(follows, round_gap(c, impulse.center_offset), impulse.separation.x);
    return impulse;
}

// Restart (O'Donoghue, Candes, Adaptive restart for accelerated gradient schemes, Found. Comput. Math. 15, 2015). After a blow
// the iteration converges in the more substeps the lighter the struck bodies are; its impulses are greatest when the heavy body
// has stopped, and throw it back while they fall. So a point that parts starts the next substep with none, where the impulse of
// its contact falls by more than a blow's part. Both limits in what gravity adds to a speed in a substep: of the parting, and of
// the change that the fallen impulse makes to the lighter body.
CONSTANT float PARTING = 1.5f, FALLING = 5.0f;

// The relax pass, after the positions were integrated with `moved`: updates separations, removes the spring's velocity,
// applies restitution and friction. `part`: part_of_stiffness().
LAW SolveResult relax_contact(Constraint c, Impulse impulse, VelocityPair moved, VelocityPair v, Mass a, Mass b,
                              ImpactContext around, float part, Parameters parameters) {
    // A block solves its contacts one after the other: in the biased pass from the first to the last, here backwards.
    bool struck = is_impact(impulse), in_block = follows_in_block(c) || leads_in_block(c);
    Constraint met = c;
    vec3 met_offset = impulse.center_offset;
    bool follows = is_of_round_bodies(c);
    if (!none(struck || follows)) met = refresh_round_contact(c, met_offset);
    bool gone = impulse.slide_distance > c.slide_limit;  // as in the biased pass: this substep's impact stays
    impulse = after_motion(c, stretched(met, impulse, moved, parameters), moved, parameters);
    c = refresh_round_contact(c, impulse.center_offset);
    vec3 speeds = normal_speeds(c, impulse.center_offset, v), press = vec3(0.0f);
    bool arrives = is_fast(-speeds.x, parameters) && !(c.restitution > 0.0f);
    NormalRows rows = normal_rows(c, impulse.center_offset, with_relaxation(a, arrives, 1.0f, parameters),
                                  with_relaxation(b, arrives, 1.0f, parameters));
    float biased = normal_impulse(impulse);
    if (!none(struck)) {
        vec4 before = impulse.normal;
        NormalRows met_rows = normal_rows(met, met_offset, a, b);
        vec3 reached = normal_speeds(met, met_offset, before_motion(v, a, b, parameters.h));
        impulse = with_restitution(met, met_rows, reached, c, impulse, rows, speeds, a, b, around);
        for (int k = 0; k < 4; ++k) press = press + press_at(c, impulse.normal[k] - before[k], k);
        speeds = speeds + response_to(rows, press);
    }
    // Nothing begins here: only the biased pass knows among how many contacts a body is split.
    bool begins = biased > 0.0f && !(c.restitution > 0.0f);
    vec4 parting = vec4(0.0f);
    uint sweeps = sweeps_of(c, speeds, a, b, parameters);
    int sweep = 0;
    do {
        for (int k = 0; k < 4; ++k) {
            bool there = uint(sweep) < sweeps && uint(k) < point_count(c);
            if (none(there)) break;
            bool rebounds = impulse.impact[k] > 0.0f;
            float speed = speed_at(c, speeds, k);
            float target = choose(impulse.separation[k] > 0.0f, impulse.separation[k] * parameters.inverse_h, 0.0f);
            float before = impulse.normal[k];
            bool acts = there && !rebounds && (before > 0.0f || (begins && !gone && speed + target < 0.0f));
            if (none(acts)) continue;
            vec3 response = response_at(rows, c, k);
            float mass = reciprocal(speed_at(c, response, k));
            acts = acts && !(c.restitution > 0.0f && before <= -IMPACT_DISTANCE * mass * speed);  // an impact, or none
            float after =
                choose(acts, choose(gone, 0.0f, positive(flush_tiny(before - (part * mass) * (speed + target)))), before);
            impulse.normal[k] = after;
            speeds = speeds + response * (after - before);
            press = press + press_at(c, after - before, k);
            parting[k] = choose(acts, choose(speed > PARTING * fall_speed(parameters), 1.0f, 0.0f), parting[k]);
        }
        ++sweep;
    } while (!none(uint(sweep) < sweeps));
    SolveResult result = result_of(c, impulse, speeds, press);
    result.pair_velocity = v;
    float normal = normal_impulse(impulse);
    bool again = struck || in_block || needs_friction_again(c, impulse, press, normal);
    if (!none(again)) {
        SolveResult moves = result;
        moves.pair_velocity = exerted(v, result.wrench, lever_arms(c, c.centre, impulse.center_offset), a, b);
        result = choose(again, solve_relaxed_friction(c, moves, normal, a, b, struck, false, parameters), result);
    }
    float fall = impulse.normal_sum - normal;
    bool restarts = fall * larger(a.inverse_mass, b.inverse_mass) > FALLING * fall_speed(parameters);
    result.restarts = choose(restarts, parting, vec4(0.0f));
    return result;
}

// All that a contact exerts.
LAW Wrench wrench_of(Constraint c, Impulse impulse) {
    vec3 press = vec3(0.0f);
    for (int k = 0; k < 4; ++k) press = press + press_at(c, impulse.normal[k], k);
    Wrench wrench = wrench_of_press(c, press);
    wrench.push = wrench.push + impulse.friction;
    wrench.moment = wrench.moment + (impulse.rolling + c.normal * impulse.twist);
    return wrench;
}
// The warm start of a substep: what the impulses of the last one change.
LAW VelocityPair warm_start(Constraint c, Impulse impulse, Mass a, Mass b) {
    c = refresh_round_contact(c, impulse.center_offset);
    return changes_by(wrench_of(c, impulse), lever_arms(c, c.centre, impulse.center_offset), a, b);
}
// What a pass has changed, and what the impulses do with which the next substep begins. `c`: at the present poses.
LAW VelocityPair changes_after(Constraint c, SolveResult after, Impulse next, bool warm_starts, Mass a, Mass b) {
    Wrench begins = wrench_of(c, next), wrench;
    wrench.push = after.wrench.push + choose(warm_starts, begins.push, vec3(0.0f));
    wrench.moment = after.wrench.moment + choose(warm_starts, begins.moment, vec3(0.0f));
    return changes_by(wrench, lever_arms(c, c.centre, after.impulse.center_offset), a, b);
}

// The separation, m, below which a point counts, and whether a point comes that near within the next substep; `speed`: of the
// separation, m/s.
LAW float counted_separation(Parameters parameters) {
    return 2.0f * parameters.h * parameters.h * length3(parameters.gravity);
}
LAW bool comes_near(float separation, float speed, float near, Parameters parameters) {
    return separation + parameters.h * speed < near;
}
// Whether the contact counts in mass splitting, 1 or 0: a point bears a normal impulse, or will within the next
// substep, gravity included.
LAW float is_active_at(Constraint c, Impulse impulse, vec3 speeds, Parameters parameters) {
    bool open = !(impulse.slide_distance > c.slide_limit), counted = false;
    float near = counted_separation(parameters);
    for (int k = 0; k < 4; ++k) {
        bool counts = impulse.normal[k] > 0.0f || comes_near(impulse.separation[k], speed_at(c, speeds, k), near, parameters);
        counted = counted || (uint(k) < point_count(c) && counts);
    }
    return choose(open && counted, 1.0f, 0.0f);
}
LAW float is_active(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    c = refresh_round_contact(c, impulse.center_offset);
    return is_active_at(c, impulse, normal_speeds(c, impulse.center_offset, v), parameters);
}

// The same for the next substep, after the relax pass: what bore in the biased pass counts, too. A heavy body that falls upon a
// light one presses it onto its supports in every biased pass, and the light body leaves them again in every relax pass.
LAW float counts_next(Constraint c, Impulse biased, Impulse relaxed, vec3 speeds, Parameters parameters) {
    return choose(normal_impulse(biased) > 0.0f, 1.0f, is_active_at(c, relaxed, speeds, parameters));
}

// A contact is unloaded if all its impulses are zero. A pass changes nothing of such a contact but what after_motion() does, and
// gives it no share in the bodies' masses, unless the contact becomes loaded in that pass, or counts for the next. These two tell
// whether it may; they are conservative, and require finite velocities and parameters in their ranges.
LAW bool may_load_biased(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    c = refresh_round_contact(c, impulse.center_offset);
    bool open = !(impulse.slide_distance > c.slide_limit), loads = false;
    vec3 speeds = normal_speeds(c, impulse.center_offset, v);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) break;
        float separation = impulse.separation[k];
        bool waits = separation > 0.0f && speed_at(c, speeds, k) + separation * parameters.inverse_h >= 0.0f;
        loads = loads || (there && open && !waits);
    }
    return loads;
}
// In the relax pass, after the motion.
LAW bool may_load_relaxed(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    c = refresh_round_contact(c, impulse.center_offset);
    float near = counted_separation(parameters);
    bool open = !(impulse.slide_distance > c.slide_limit), loads = false;
    vec3 speeds = normal_speeds(c, impulse.center_offset, v);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) break;
        float speed = speed_at(c, speeds, k);
        loads = loads || (there && open && comes_near(impulse.separation[k], speed, near, parameters));
    }
    return loads;
}

LAW VelocityDelta velocity_delta(Velocity share, float weight, float passed_on) {
    VelocityDelta slot;
    slot.linear = flush_tiny(share.linear);
    slot.weight = weight;
    slot.angular = flush_tiny(share.angular);
    slot.passed_on = passed_on;
    return slot;
}
LAWS_END

#endif
