// Restitution: impact velocities, and the rebound velocities that the relax pass aims at.
//
// Restitution acts in the relax pass of the substep of the impact, not in a pass after the last substep: what
// approaches faster than the threshold leaves with e times that speed, so a bounce loses no part of a step's flight (g
// dt / v of its energy, 3% at 5 m/s and 60 Hz), and an impact propagates through a row of balls. In that pass a struck
// body is split among the contacts that strike it alone: with the usual over-relaxed split, its resting contacts would
// absorb part of the rebound, and two simultaneous impacts would rebound too fast.
//
// Symplectic Euler substeps (v += g h, x += v h) put positions exactly on a parabola whose speed is v + g h / 2 on the
// way down and v - g h / 2 on the way up: e times v alone would lose g h of the speed in every bounce (1% of the height
// from 1 m at 480 Hz). So the impact velocity is that of the parabola where it meets the surface, and the rebound is
// corrected alike.
#ifndef SCREE_PHYSICS_RESTITUTION_H
#define SCREE_PHYSICS_RESTITUTION_H

#include "shaders/physics/solve/jacobian.h"
#include "shaders/physics/solve/mass_splitting.h"

LAWS_BEGIN

// Gauss-Seidel sweeps over the points of a contact in an impact, in both passes: after a single one a box that fell
// flat on four points left spinning, and rose to half its height; after four its spin was 0.007 rad/s, after eight
// 1e-6.
CONSTANT int IMPACT_SWEEPS = 8;

// A point that bears less than this part of the impulse that would stop it is struck; one that bears more is in resting
// contact. (With 0, a row of balls that an impact's precursor had moved by 0.3 mm/s did not transmit the impact.)
CONSTANT float IMPACT_DISTANCE = 0.01f;

// What BodyForces.impacts holds: the number of impacts, negative for a body on joints.
LAW float impacts_of(float struck, BodyProperties body) {
    return choose(body.joints != NONE, -struck, struck);
}

// xyz: relative acceleration (B minus A), m/s^2; w: impacts of the body that has more of them, negative if one of the two
// is on joints.
LAW vec4 impact_state(BodyForces a, BodyForces b) {
    float most = larger(abs(a.impacts), abs(b.impacts));
    return vec4(b.acceleration - a.acceleration, choose(a.impacts < 0.0f || b.impacts < 0.0f, -most, most));
}

// Slower approaches have no restitution, m/s: what rests on a surface approaches at up to the speed of a fall in two
// steps, and bodies beside each other do not. (With a lower threshold for the bodies that an impact has just pushed, a
// heap of 200 boxes gained 2e-4 of its energy in a step.)
LAW float slowest_impact(Constraint c, vec4 state, Parameters parameters) {
    float pull = larger(abs(dot3(c.normal, parameters.gravity)), abs(dot3(c.normal, xyz(state))));
    float threshold = choose(c.restitution_threshold > 0.0f, c.restitution_threshold, parameters.restitution_threshold);
    return larger(threshold, 2.0f * parameters.dt * pull);
}

// An impact on a body of a block of joints reaches only part of the rebound, because the block passes on the rest of the
// impulse. So the impact lasts: in the next substeps the points are driven by what is missing. (Of two balls that are
// welded one above the other the lower reaches half of the rebound, 3/4, 7/8 ...) An impact ends as that no longer
// shrinks, for instance because the body has struck another. All struck points of a contact are driven alike: where one
// of several was driven alone, it turned the body into the others, and a rod that fell flat against a wall gained
// energy.
CONSTANT float REBOUND_LEFT = 0.005f;     // of the rebound velocity: missing at the end
CONSTANT float REBOUND_PROGRESS = 0.97f;  // what is missing must shrink by this factor

// Rebound velocity without geometry, m/s: e times the impact velocity, less half a substep's relative acceleration.
LAW float plain_rebound(Constraint c, float impact_velocity, float pull, Parameters parameters) {
    return positive(-(c.restitution * impact_velocity + 0.5f * parameters.h * pull));
}

// As a substep begins: whether the impact of the last one has rebounded, and if not, what its points miss.
LAW Impulse impact_in_progress(Constraint c, Impulse impulse, VelocityPair v, vec4 state, Parameters parameters) {
    float pull = dot3(c.normal, xyz(state));
    bool lasts = true;
    float least = 1.0e30f;
    for (int k = 0; k < 4; ++k) {
        bool struck = uint(k) < point_count(c) && impulse.rebound_deficit[k] > 0.0f;
        float impact_velocity = 0.0f;
        if (!none(struck)) {
            // By now gravity has changed the velocity that the rebound shall reach.
            impact_velocity = impulse.impact_velocity[k] - parameters.h * pull * reciprocal(c.restitution);
            float wanted = plain_rebound(c, impact_velocity, pull, parameters);
            float missing = wanted - dot3(c.normal, velocity_at(lever_arms(c, lever_arm(c, k), impulse.center_offset), v));
            bool misses = missing > REBOUND_LEFT * wanted && missing < REBOUND_PROGRESS * impulse.rebound_deficit[k];
            lasts = lasts && (!struck || (impact_velocity < 0.0f && misses));
            least = choose(struck, smaller(least, missing), least);
        }
        impulse.impact_velocity[k] = choose(struck, impact_velocity, 0.0f);
    }
    for (int k = 0; k < 4; ++k) {
        bool struck = uint(k) < point_count(c) && impulse.rebound_deficit[k] > 0.0f;
        impulse.rebound_deficit[k] = choose(struck && lasts, least, 0.0f);
        impulse.impact_velocity[k] = choose(struck && lasts, impulse.impact_velocity[k], 0.0f);
    }
    return impulse;
}

// Normal velocities at which points strike, m/s, < 0; 0 for those that do not rebound. Measured before any point is
// solved, because solving one turns the bodies at the others. The surface is met after a part of the substep.
LAW vec4 impact_velocities(Constraint c, Impulse impulse, VelocityPair v, Mass a, Mass b, vec4 state, Parameters parameters) {
    vec4 found = impulse.impact_velocity;
    float gain = parameters.h * dot3(c.normal, xyz(state));
    float slowest = slowest_impact(c, state, parameters);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c) && found[k] == 0.0f;
        if (none(there)) continue;
        JacobianRow row = jacobian_row(lever_arms(c, lever_arm(c, k), impulse.center_offset), c.normal, a, b);
        float speed = speed_along(row, v);
        float way = parameters.h * speed;
        bool strikes = impulse.normal[k] <= -IMPACT_DISTANCE * mass_along(row, a, b) * speed;
        bool meets = there && strikes && speed < -slowest && impulse.separation[k] + way < 0.0f;
        if (none(meets)) continue;
        float part = choose(impulse.separation[k] > 0.0f, -impulse.separation[k] * reciprocal(way), 0.0f);
        // Clamped: accelerations that exceed the speed itself within one substep are beyond this model.
        found[k] = choose(meets, smaller(speed + gain * (part - 0.5f), 0.5f * speed), found[k]);
    }
    return found;
}

// Velocities at which the points shall separate after an impact, m/s, >= 0: e times the impact velocity, less half a
// substep's relative acceleration along the normal.
//
// `met` and `offset` are the constraint and the offset of the centres in the biased pass, which took the approach out
// along that normal. The bodies have moved since, and normal and lever arms with them: along the new row the same
// velocity would mean another energy (two balls off centre gained up to 20% at 150 m/s). So the rebound is the velocity
// that adds as much energy along the new row (inverse effective mass k, velocity w) as e v along the one of the impact:
// (u^2 - w^2) / k = ((e v)^2 - w_met^2) / k_met.
LAW vec4 rebound_velocities(Constraint met, vec3 offset, Constraint c, Impulse impulse, VelocityPair v, Mass a, Mass b,
                            vec4 state, Parameters parameters) {
    vec4 found = vec4(0.0f);
    float pull = dot3(met.normal, xyz(state));
    for (int k = 0; k < 4; ++k) {
        bool struck = uint(k) < point_count(c) && impulse.impact_velocity[k] < 0.0f;
        if (none(struck)) continue;
        JacobianRow before = jacobian_row(lever_arms(met, lever_arm(met, k), offset), met.normal, a, b);
        JacobianRow now = jacobian_row(lever_arms(c, lever_arm(c, k), impulse.center_offset), c.normal, a, b);
        float wanted = plain_rebound(c, impulse.impact_velocity[k], pull, parameters);
        float speed_before = speed_along(before, v), speed = speed_along(now, v);
        float ratio = mass_along(before, a, b) * reciprocal(mass_along(now, a, b));
        float squared = speed * speed + ratio * (wanted * wanted - speed_before * speed_before);
        float missing = impulse.rebound_deficit[k];
        found[k] = choose(struck, choose(missing > 0.0f, speed + missing, square_root(positive(squared))), found[k]);
    }
    return found;
}

// The weight of a contact among the impacts of its bodies: 0 without impact, 1 as it begins, then what is missing. (With 1
// until the end, the second blow in a row of balls on rods would find half a ball.)
LAW float impact_weight(Impulse impulse) {
    float weight = 0.0f;
    for (int k = 0; k < 4; ++k) {
        float velocity = -impulse.impact_velocity[k], missing = impulse.rebound_deficit[k];
        float part = choose(missing > 0.0f, smaller(1.0f, missing * reciprocal(larger(velocity, 1.0e-20f))), 1.0f);
        weight = choose(velocity > 0.0f, larger(weight, part), weight);
    }
    return weight;
}
LAW float is_impact(Impulse impulse) {
    vec4 a = impulse.impact_velocity;
    return choose(a.x < 0.0f || a.y < 0.0f || a.z < 0.0f || a.w < 0.0f, 1.0f, 0.0f);
}

// After the relax pass: an impact on a joined body goes on, towards what was aimed at.
LAW Impulse rebounding(Constraint c, Impulse impulse, vec4 rebound, vec4 state, Parameters parameters) {
    float pull = dot3(c.normal, xyz(state));
    for (int k = 0; k < 4; ++k) {
        bool struck = uint(k) < point_count(c) && impulse.impact_velocity[k] < 0.0f;
        if (none(struck)) continue;
        float aimed = -(rebound[k] + 0.5f * parameters.h * pull) * reciprocal(c.restitution);
        bool goes_on = impulse.rebound_deficit[k] > 0.0f;
        bool begins = struck && (state.w < 0.0f || (state.w > 1.5f && point_count(c) == 1u)) && !goes_on && aimed < 0.0f;
        impulse.rebound_deficit[k] = choose(begins, rebound[k] - impulse.impact_velocity[k], impulse.rebound_deficit[k]);
        impulse.impact_velocity[k] = choose(begins, aimed, impulse.impact_velocity[k]);
    }
    return impulse;
}

// The split mass in the relax pass: a struck body is split among its impacts by their weights.
LAW Mass impact_mass(Impulse impulse, BodyMass body, BodyForces load, Parameters parameters) {
    Mass mass = split_mass(body, impulse, parameters);
    float weight = impact_weight(impulse);
    float split = abs(load.impacts) * reciprocal(larger(weight, 1.0e-3f));
    mass.split = choose(weight > 0.0f, larger(1.0f, split), mass.split);
    return mass;
}

// Removes the impulses of impacts, which must not warm start the next substep.
LAW Impulse clear_impacts(Impulse impulse, uint count) {
    bool blow = false;
    float normal = 0.0f;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < count;
        if (none(there)) break;
        bool struck = there && impulse.impact_velocity[k] < 0.0f;
        impulse.normal[k] = choose(struck, 0.0f, impulse.normal[k]);
        impulse.solved_normal[k] = choose(struck, 0.0f, impulse.solved_normal[k]);
        blow = blow || struck;
        normal = choose(there, normal + impulse.normal[k], normal);
    }
    bool spent = blow && normal == 0.0f;
    impulse.friction = choose(spent, vec3(0.0f), impulse.friction);
    impulse.twist = choose(spent, 0.0f, impulse.twist);
    impulse.rolling = choose(spent, vec3(0.0f), impulse.rolling);
    impulse.stretch = choose(spent, vec3(0.0f), impulse.stretch);
    impulse.turn = choose(spent, 0.0f, impulse.turn);
    return impulse;
}

LAW uint sweeps_of(Constraint c, Impulse impulse) {
    return choose(point_count(c) > 1u && is_impact(impulse) > 0.0f, uint(IMPACT_SWEEPS), 1u);
}

LAWS_END

#endif
