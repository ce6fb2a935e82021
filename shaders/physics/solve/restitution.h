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

// Relative acceleration (B minus A), m/s^2.
LAW vec3 relative_acceleration(BodyForces a, BodyForces b) {
    return b.acceleration - a.acceleration;
}

// Normal velocities at which points strike, m/s, < 0; 0 for those that do not rebound. Measured before any point is
// solved, because solving one turns the bodies at the others. The surface is met after a part of the substep.
LAW vec4 impact_velocities(Constraint c, Impulse impulse, VelocityPair v, Mass a, Mass b, vec3 pull, Parameters parameters) {
    vec4 found = vec4(0.0f);
    float gain = parameters.h * dot3(c.normal, pull);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < c.count;
        if (none(there)) break;
        JacobianRow row = jacobian_row(lever_arms(c, xyz(c.arms[k]), impulse.center_offset), c.normal, a, b);
        float speed = speed_along(row, v);
        float way = parameters.h * speed;
        bool strikes = impulse.normal[k] <= -IMPACT_DISTANCE * mass_along(row, a, b) * speed;
        bool meets = there && strikes && speed < -parameters.restitution_threshold && impulse.separation[k] + way < 0.0f;
        if (none(meets)) continue;
        float part = choose(impulse.separation[k] > 0.0f, -impulse.separation[k] * reciprocal(way), 0.0f);
        // Clamped: accelerations that exceed the speed itself within one substep are beyond this model.
        found[k] = choose(meets, smaller(speed + gain * (part - 0.5f), 0.5f * speed), found[k]);
    }
    return found;
}

// Bias of the relax pass after an impact, minus the rebound velocity (<= 0): e times the impact velocity, plus half a
// substep's relative acceleration along the normal.
LAW float restitution_target(Constraint c, float impact_velocity, vec3 pull, Parameters parameters) {
    return smaller(c.restitution * impact_velocity + 0.5f * parameters.h * dot3(c.normal, pull), 0.0f);
}

LAW float is_impact(Impulse impulse) {
    vec4 a = impulse.impact_velocity;
    return choose(a.x < 0.0f || a.y < 0.0f || a.z < 0.0f || a.w < 0.0f, 1.0f, 0.0f);
}

// The split mass in the relax pass: a struck body is split evenly among its impacts.
LAW Mass impact_mass(Impulse impulse, Mass mass, BodyForces load, Parameters parameters) {
    mass = split_mass(mass, impulse, parameters);
    mass.split = choose(is_impact(impulse) > 0.0f, larger(1.0f, load.impacts), mass.split);
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
    return impulse;
}

LAW uint sweeps_of(Constraint c, Impulse impulse) {
    return choose(c.count > 1u && is_impact(impulse) > 0.0f, uint(IMPACT_SWEEPS), 1u);
}

LAWS_END

#endif
