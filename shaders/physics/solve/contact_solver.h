// Contact constraint solver: each contact is one block of a mass-splitting Jacobi iteration.
//
// Mass splitting (Tonge, Benevolenski, Voroshilov, Mass Splitting for Jitter-Free Parallel Rigid Body Simulation,
// SIGGRAPH 2012): a body in n contacts is split into one body of mass m/s for each, s = max(1, n/1.5) if their normal
// impulses are equal (mass_splitting.h). A contact solves its points by Gauss-Seidel on its two split bodies, and each
// whole body receives 1/s of its split body's velocity change. So contacts are independent, momentum is exact, the
// order of contacts means nothing, and the iteration converges (s = n/omega with omega < 2 is over-relaxed Jacobi on
// the split masses). n counts only active contacts, which bear a normal impulse or will in the next substep: a ball
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
// Impulses have momentum from substep to substep (contact_momentum.h). The contacts of one pair of bodies are one block
// (contact_block.h).
//
// Measured alternatives (without momentum; 8 substeps; drift after 20 s of a column of 40, a pyramid of 465 boxes, a wall of
// 520):
//   as it is                                            0.117 m  0.048 m  0.021 m
//   contact frequency 0.125/h; 0.16/h in place of 0.14  0.147; 0.090   with 0.16 a pyramid of 210 is not quiet within 8 s
//   contact frequency 0.18/h                            0.071             that pyramid creeps at 25 mm/s
//   n as in this substep (mass_splitting.h)             columns in a pile of ten thousand sway at 3 to 80 mm/s for ever
// and with 0.125/h:
//   as it is                                            0.147 m  0.048 m  0.026 m
//   relaxation 1.8 in place of 1.5                      both columns, of 20 and of 40, fall within seconds
//   relaxation 1.2                                      columns compress by a quarter more
//   damping ratio 20; 40                                0.147; 0.148   0.056; 0.066   0.027; 0.029
#ifndef SCREE_PHYSICS_CONTACT_SOLVER_H
#define SCREE_PHYSICS_CONTACT_SOLVER_H

#include "shaders/physics/solve/contact_momentum.h"
#include "shaders/physics/solve/friction.h"
#include "shaders/physics/solve/jacobian.h"
#include "shaders/physics/solve/mass_splitting.h"
#include "shaders/physics/solve/restitution.h"

LAWS_BEGIN

LAW float round_gap(Constraint c, vec3 d) {
    return length3((d + c.centre) - lever_arm(c, 0)) - (c.radius_a + c.radius_b);
}
// The constraint at the present poses: between two round bodies, normal and point follow the centres of curvature.
LAW Constraint refresh_round_contact(Constraint c, vec3 d) {
    bool follows = is_of_round_bodies(c);
    if (none(follows)) return c;
    vec3 core = lever_arm(c, 0);
    bool driven = follows && is_driven(c);
    vec3 drive = vec3(0.0f);
    if (!none(driven)) drive = drive_of(c);
    c.normal = choose(follows, unit3((d + c.centre) - core, c.normal), c.normal);
    vec3 arm = core + c.normal * (c.radius_a + 0.5f * round_gap(c, d));
    c = with_lever_arm(c, 0, choose(follows, arm, core));
    if (!none(driven)) c = choose_drive(driven, with_drive(c, drive), c);
    c.centre = choose(follows, arm, c.centre);
    c.flags = choose(follows, c.flags & ~CONSTRAINT_ROUND, c.flags);
    return c;
}

// A contact that bears nothing and approaches faster than gravity makes it in so many substeps waits for the next substep, where
// its bodies are split among all that they meet. The relax pass knows only the contacts that were active when the substep began:
// of 2,000 heavy bodies that fell upon light ones on up to five supports, 213 left with more energy than they brought, up to
// hundreds of times, because each support answered with the whole mass. With restitution every approach of a point waits, and is
// an impact there or none. (With an impulse for what a speculative impact had moved by 0.02 m/s, a ball was in resting contact
// with the next one when the rest of the impact came, and a touching row of four passed on a third of its energy.)
CONSTANT float ARRIVAL = 4.0f;

// The biased pass: normal impulses of soft constraints, or speculative ones (no bias, up to contact) where the bodies
// are still apart. `part`: part_of_stiffness() of its block, 1 for a contact by itself.
LAW SolveResult solve_contact(Constraint c, Impulse impulse, VelocityPair v, Mass a, Mass b, ImpactContext around, float part,
                              Parameters parameters) {
    c = refresh_round_contact(c, impulse.center_offset);
    bool gone = impulse.slide_distance > c.slide_limit;
    // Push-out speed, divided by the split factor because the pushes of overlapping neighbours add up from layer to
    // layer. At most by 4: a tray under hundreds of boxes must still bear them.
    float push_speed = parameters.push_speed * reciprocal(smaller(4.0f, larger(a.split, b.split)));
    bool bounces = may_rebound(c, around);
    vec4 striking = vec4(0.0f);
    if (none(bounces)) {
        impulse = with_impact(impulse, impulse, false);  // also of an impact that lasts while restitution is taken away
    } else {
        impulse = with_impact(impulse, impact_in_progress(c, impulse, v, around, parameters), bounces && !gone);
        striking = choose(bounces, impact_velocities(c, impulse, v, a, b, around, parameters), vec4(0.0f));
    }
    bool strikes = is_any(striking);
    // A single sweep would leave what falls flat without restitution with a spin.
    bool arrives = point_count(c) > 1u && normal_impulse(impulse) == 0.0f;
    if (!none(arrives)) {
        float speed = normal_speed(c, c.centre, impulse.center_offset, v);
        arrives = arrives && speed < -ARRIVAL * fall_speed(parameters);
    }
    vec4 normal_before = impulse.normal;
    VelocityPair before_impact = v;
    float normal = 0.0f;
    float cut = choose((c.flags & CONSTRAINT_RESTLESS) != 0u, 0.0f, LEAK_CUT);
    uint sweeps = choose((strikes && point_count(c) > 1u) || arrives, uint(IMPACT_SWEEPS), 1u);
    for (int sweep = 0; !none(uint(sweep) < sweeps); ++sweep) {
        bool swept = uint(sweep) < sweeps;
        normal = choose(swept, 0.0f, normal);
        for (int k = 0; k < 4; ++k) {
            bool there = swept && uint(k) < point_count(c);
            if (none(there)) break;
            LeverArms r = lever_arms(c, lever_arm(c, k), impulse.center_offset);
            float speed = dot3(c.normal, velocity_at(r, v));
            float separation = impulse.separation[k];
            float before = impulse.normal[k];
            float bias = larger(parameters.mass_scale * parameters.bias_rate * separation, -push_speed);
            float excess =
                choose(separation > 0.0f, speed + separation * parameters.inverse_h, parameters.mass_scale * speed + bias);
            bool acts = there && !(before == 0.0f && (gone || excess >= 0.0f));
            if (none(acts)) continue;  // a third of all contacts are speculative and inactive
            JacobianRow row = jacobian_row(r, c.normal, a, b);
            float change = -mass_along(row, a, b) * excess;
            float leak = parameters.impulse_scale * (1.0f - cut * contact_momentum(row, point_count(c), a, b, parameters));
            change = choose(separation <= 0.0f, part * change - leak * before, change);
            float after = choose(gone, 0.0f, positive(flush_tiny(before + change)));
            impulse.normal[k] = choose(acts, after, before);
            normal = choose(acts, normal + after, normal);
            v = choose(acts, pushed(v, row, after - before, a, a.split, b, b.split), v);
        }
    }
    SolveResult result;
    result.impulse = impulse;
    if (!none(strikes || is_impact(impulse)))
        result.impulse = after_compression(c, impulse, striking, normal_before, before_impact, v, a, b, around, parameters);
    result.pair_velocity = v;
    return solve_patch_friction(c, result, normal, a, b, true, parameters);
}

// A body in motion that contacts do not move; what it meets does not wait: after the last substep it would be left behind. For
// the same reason nothing without restitution waits in the last substep (continuous collision would clamp what moves on, and a
// clamp changes the angular momentum), nor what would be through the other body in one substep (longest_wait()).
LAW bool drives(Mass mass, Velocity velocity) {
    return mass.inverse_mass == 0.0f && dot3(velocity.linear, velocity.linear) + dot3(velocity.angular, velocity.angular) > 0.0f;
}
LAW float arrival_speed(Constraint c, VelocityPair v, Mass a, Mass b, bool last, Parameters parameters) {
    bool goes_on = last || drives(a, v.a) || drives(b, v.b);
    float least = choose(goes_on, 1.0e30f, ARRIVAL * fall_speed(parameters));
    return choose(c.restitution > 0.0f, 0.0f, least);
}
// The fastest approach that waits, m/s.
LAW float longest_wait(Constraint c, Parameters parameters) {
    return choose(c.restitution > 0.0f, 1.0e30f, (2.0f * c.slide_limit) * parameters.inverse_h);
}

// Whether a contact without restitution arrives beside others: it approaches faster than what waits, and has borne less than what
// stops it. In the biased pass shares of the mass that are over-relaxed overshoot, and the relax pass takes that back. What
// overshoots in the relax pass is gone, so a contact that arrives there answers with its true share. (With over-relaxed shares,
// boxes and balls that fell upon two to nine fixed boxes side by side rose with 13 to 25% of their speed in the mean, at worst
// with 4.7 times of it; now with 0.1 to 0.7%, at worst 8%.)
LAW bool arrives_among_others(Constraint c, Impulse impulse, VelocityPair v, Mass a, Mass b, Parameters parameters) {
    bool arrives = larger(a.split, b.split) > 1.0f && !(c.restitution > 0.0f);
    if (none(arrives)) return arrives;
    LeverArms r = lever_arms(c, c.centre, impulse.center_offset);
    float speed = dot3(c.normal, velocity_at(r, v));
    arrives = arrives && speed < -ARRIVAL * fall_speed(parameters);
    if (none(arrives)) return arrives;
    return arrives && normal_impulse(impulse) <= -mass_along(jacobian_row(r, c.normal, a, b), a, b) * speed;
}
LAW float true_split(float split, Parameters parameters) {
    return choose(split > 1.0f, split * reciprocal(parameters.inverse_relaxation), split);
}
// The change of the split bodies' velocities, scaled.
LAW VelocityPair scaled_change(VelocityPair before, VelocityPair after, float of_a, float of_b) {
    after.a.linear = before.a.linear + (after.a.linear - before.a.linear) * of_a;
    after.a.angular = before.a.angular + (after.a.angular - before.a.angular) * of_a;
    after.b.linear = before.b.linear + (after.b.linear - before.b.linear) * of_b;
    after.b.angular = before.b.angular + (after.b.angular - before.b.angular) * of_b;
    return after;
}

// After the positions were integrated with `moved`: the separations, the offset between the centres and the way of the slide,
// from where the bodies meet. (Counted from the start of the step, the contact of a body that came down at a slant was gone
// before it touched: heaps that fell into a narrow bin were a seventh deeper.)
LAW Impulse after_motion(Constraint c, Impulse impulse, VelocityPair moved, Parameters parameters) {
    bool follows = is_of_round_bodies(c), meets = false;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c) && !follows;
        if (none(there)) break;
        float speed = normal_speed(c, lever_arm(c, k), impulse.center_offset, moved);
        float separation = impulse.separation[k] + parameters.h * speed;
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

// The relax pass, after the positions were integrated with `moved`: updates separations, removes the spring's velocity,
// applies restitution and friction. `part`: part_of_stiffness(); `last`: in the last substep of a step.
LAW SolveResult relax_contact(Constraint c, Impulse impulse, VelocityPair moved, VelocityPair v, Mass a, Mass b,
                              ImpactContext around, float part, bool last, Parameters parameters) {
    bool struck = is_impact(impulse);
    Constraint met = c;
    vec3 met_offset = impulse.center_offset;
    bool follows = is_of_round_bodies(c);
    if (!none(struck || follows)) met = refresh_round_contact(c, met_offset);
    bool gone = impulse.slide_distance > c.slide_limit;  // as in the biased pass: this substep's impact stays
    impulse = after_motion(c, stretched(met, impulse, moved, parameters), moved, parameters);
    c = refresh_round_contact(c, impulse.center_offset);
    SolveResult result;
    result.impulse = impulse;
    result.pair_velocity = v;
    if (!none(struck))
        result = with_restitution(met, met_offset, before_motion(v, a, b, parameters.h), c, impulse, v, a, b, around);
    impulse = result.impulse;
    v = result.pair_velocity;
    float arrival = arrival_speed(c, v, a, b, last, parameters);
    float fastest = longest_wait(c, parameters);
    float split_a = a.split, split_b = b.split;
    VelocityPair before_arrival = v;
    bool arriving = arrives_among_others(c, impulse, v, a, b, parameters);
    if (!none(arriving)) {
        a.split = choose(arriving, true_split(split_a, parameters), split_a);
        b.split = choose(arriving, true_split(split_b, parameters), split_b);
    }
    float normal = 0.0f;
    vec4 momentum = vec4(0.0f), parting = vec4(0.0f);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) break;
        bool rebounds = there && impulse.impact[k] > 0.0f;
        normal = choose(rebounds, normal + impulse.normal[k], normal);
        LeverArms r = lever_arms(c, lever_arm(c, k), impulse.center_offset);
        float speed = dot3(c.normal, velocity_at(r, v));
        float target = choose(impulse.separation[k] > 0.0f, impulse.separation[k] * parameters.inverse_h, 0.0f);
        float before = impulse.normal[k];
        bool waits = speed < -arrival && speed > -fastest;
        bool acts = there && !rebounds && !(before == 0.0f && (gone || speed + target >= 0.0f || waits));
        if (none(acts)) continue;
        JacobianRow row = jacobian_row(r, c.normal, a, b);
        float mass = mass_along(row, a, b);
        momentum[k] = choose(acts, contact_momentum(row, point_count(c), a, b, parameters), momentum[k]);
        parting[k] = choose(acts && speed > PARTING * fall_speed(parameters), 1.0f, 0.0f);
        acts = acts && !(c.restitution > 0.0f && waits && before <= -IMPACT_DISTANCE * mass * speed);
        float after = choose(gone, 0.0f, positive(flush_tiny(before - (part * mass) * (speed + target))));
        impulse.normal[k] = choose(acts, after, before);
        normal = choose(acts, normal + after, normal);
        v = choose(acts, pushed(v, row, after - before, a, a.split, b, b.split), v);
    }
    if (!none(arriving)) {
        float of_a = split_a * reciprocal(a.split), of_b = split_b * reciprocal(b.split);
        v = choose(arriving, scaled_change(before_arrival, v, of_a, of_b), v);
        a.split = split_a;
        b.split = split_b;
    }
    float borne = solved_impulse(impulse), fall = borne - normal;
    bool falls = fall > FALLING_PART * borne && fall * larger(a.inverse_mass, b.inverse_mass) > FALLING * fall_speed(parameters);
    result.impulse = with_momentum(impulse, point_count(c), momentum, choose(falls, parting, vec4(0.0f)));
    result.pair_velocity = v;
    return solve_patch_friction(c, result, normal, a, b, false, parameters);
}

// Warm start: `v` plus what the previous substep's impulses do to the whole (not split) bodies.
LAW VelocityPair warm_start(Constraint c, Impulse impulse, VelocityPair v, Mass a, Mass b) {
    c = refresh_round_contact(c, impulse.center_offset);
    float normal = impulse.normal.x;
    vec3 moment = lever_arm(c, 0) * impulse.normal.x;
    for (int k = 1; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) break;
        normal = choose(there, normal + impulse.normal[k], normal);
        moment = choose(there, moment + lever_arm(c, k) * impulse.normal[k], moment);
    }
    bool acts = normal != 0.0f || has_friction(impulse);
    if (none(acts)) return v;
    // All normal impulses are parallel, so the sum of their moments gives the torque on each body.
    vec3 across = impulse.center_offset * normal;
    vec3 push = c.normal * normal + impulse.friction;
    vec3 twist = impulse.rolling + c.normal * impulse.twist;
    LeverArms r = lever_arms(c, c.centre, impulse.center_offset);
    bool on_b = is_on_b(c);
    vec3 about_a = cross3(choose(on_b, moment + across, moment), c.normal) + cross3(r.a, impulse.friction) + twist;
    vec3 about_b = cross3(choose(on_b, moment, moment - across), c.normal) + cross3(r.b, impulse.friction) + twist;
    VelocityPair after = v;
    after.a.linear = v.a.linear - push * a.inverse_mass;
    after.a.angular = v.a.angular - turned_by(a, about_a);
    after.b.linear = v.b.linear + push * b.inverse_mass;
    after.b.angular = v.b.angular + turned_by(b, about_b);
    return choose(acts, after, v);
}

// The separation, m, below which a point counts, and whether a point comes that near within the next substep; `speed`: of the
// separation, m/s.
LAW float counted_separation(Parameters parameters) {
    return 2.0f * parameters.h * parameters.h * length3(parameters.gravity);
}
LAW bool comes_near(Constraint c, float separation, float speed, float near, Parameters parameters) {
    bool arrives = speed < -ARRIVAL * fall_speed(parameters) && !(c.restitution > 0.0f);
    float ahead = choose(arrives, 2.0f * parameters.h, parameters.h);
    return separation + ahead * speed < near;
}
// Whether the contact counts in mass splitting, 1 or 0: a point bears a normal impulse, or will within the next
// substep, gravity included. What arrives without restitution counts two substeps ahead: in the last substep of a step it acts
// before it meets (arrival_speed()), and uncounted each of several supports would answer with the whole mass.
LAW float is_active(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    bool carrying = false;
    bool open = !(impulse.slide_distance > c.slide_limit);
    c = refresh_round_contact(c, impulse.center_offset);
    float near = counted_separation(parameters);
    for (int k = 0; k < 4; ++k) {
        open = open && uint(k) < point_count(c);
        carrying = carrying || (open && impulse.normal[k] > 0.0f);
        open = open && !carrying;
        if (none(open)) break;
        float speed = normal_speed(c, lever_arm(c, k), impulse.center_offset, v);
        carrying = carrying || (open && comes_near(c, impulse.separation[k], speed, near, parameters));
        open = open && !carrying;
    }
    return choose(carrying, 1.0f, 0.0f);
}

// Impacts on a body that is split among more than so many count for the next substep.
CONSTANT float IMPACTS_AT_ONCE = 1.5f;

// is_active() for the next substep, after the relax pass: a contact that took a blow in the biased pass counts too, by what it
// does to the lighter body. A heavy body that falls upon a light one presses it onto its supports in every biased pass, and the
// light body leaves them again in every relax pass; supports that did not count would answer with the whole mass each, together
// for more than one body. (If whatever bore counted, contacts of a settling pile that come and go would keep it awake.) A single
// impact does not count, so that the next one, with another body, finds the whole mass; several at once come again together.
LAW float counts_next(Constraint c, Impulse biased, Impulse relaxed, VelocityPair v, Mass a, Mass b, Parameters parameters) {
    bool blow = is_blow(normal_impulse(biased), larger(a.inverse_mass, b.inverse_mass), parameters);
    bool struck = is_impact(biased), at_once = larger(a.split, b.split) > IMPACTS_AT_ONCE;
    return choose((struck && at_once) || (!struck && blow), 1.0f, is_active(c, relaxed, v, parameters));
}

// A contact is unloaded if all its impulses are zero. A pass changes nothing of such a contact but what after_motion() does, and
// gives it no share in the bodies' masses, unless the contact becomes loaded in that pass, or counts for the next. These two tell
// whether it may; in doubt that it may. They decide alone where velocities are sound (motion.h) and parameters in their ranges.
LAW bool may_load_biased(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    c = refresh_round_contact(c, impulse.center_offset);
    bool open = !(impulse.slide_distance > c.slide_limit), loads = false;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) break;
        float speed = normal_speed(c, lever_arm(c, k), impulse.center_offset, v);
        float separation = impulse.separation[k];
        bool waits = separation > 0.0f && speed + separation * parameters.inverse_h >= 0.0f;
        loads = loads || (there && open && !waits);
    }
    return loads;
}
// In the relax pass, after the motion.
LAW bool may_load_relaxed(Constraint c, Impulse impulse, VelocityPair v, Parameters parameters) {
    c = refresh_round_contact(c, impulse.center_offset);
    float near = counted_separation(parameters);
    bool open = !(impulse.slide_distance > c.slide_limit), loads = false;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) break;
        float speed = normal_speed(c, lever_arm(c, k), impulse.center_offset, v);
        float separation = impulse.separation[k];
        float target = choose(separation > 0.0f, separation * parameters.inverse_h, 0.0f);
        bool counts = open && comes_near(c, separation, speed, near, parameters);
        // What closes the gap comes near as well, but for rounding and contacts that end.
        loads = loads || (there && (counts || !(speed + target >= 0.0f)));
    }
    return loads;
}

// Velocity changes of the whole bodies from those of the split ones: (after - before) / split. The next warm start is
// added to them.
LAW VelocityPair to_body_deltas(VelocityPair before, VelocityPair after, Mass a, Mass b) {
    float share_a = reciprocal(a.split), share_b = reciprocal(b.split);
    VelocityPair share = before;
    share.a.linear = (after.a.linear - before.a.linear) * share_a;
    share.a.angular = (after.a.angular - before.a.angular) * share_a;
    share.b.linear = (after.b.linear - before.b.linear) * share_b;
    share.b.angular = (after.b.angular - before.b.angular) * share_b;
    return share;
}
LAW VelocityDelta velocity_delta(Velocity share, float weight, float normal_impulse) {
    VelocityDelta slot;
    slot.linear = flush_tiny(share.linear);
    slot.weight = weight;
    slot.angular = flush_tiny(share.angular);
    slot.normal_impulse = normal_impulse;
    return slot;
}
LAWS_END

#endif
