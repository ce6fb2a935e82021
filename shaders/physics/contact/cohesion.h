// Cohesion: bodies that touch attract each other, along the normals of their contacts.
//
// Rigid balls that touch hold together with F = 2 pi w R, where w is their work of adhesion and 1/R = 1/R_a + 1/R_b (Bradley,
// Phil. Mag. 13, 1932; so do stiff elastic ones: Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53, 1975). A bridge of
// liquid pulls as much with w = 2 gamma cos(theta) (Rabinovich, Esayanur, Moudgil, Langmuir 21, 2005). A body that is no ball
// has the radius of the ball of its volume; planes, height fields and what else has no volume are flat. The work of a pair is the
// geometric mean (Girifalco, Good, J. Phys. Chem. 61, 1957).
//
// The force is that of the two bodies: the contacts that they have with each other share it, and so do the points of a contact.
// It follows once a step from the gaps as the step begins, and acts like gravity through the step, in the direction of the middle
// of the step: in that of its beginning, two balls that turn about each other would turn faster and faster. (Impulses of contacts
// have the direction in which a substep begins; so has this force, in the mean.) So passes over contacts do not know of it, and
// action and reaction come from the same numbers.
#ifndef SCREE_PHYSICS_COHESION_H
#define SCREE_PHYSICS_COHESION_H

#include "shaders/physics/body/body_scale.h"
#include "shaders/physics/contact/contact_solver.h"
#include "shaders/physics/contact/material.h"

LAWS_BEGIN

// Up to which gap bodies attract each other, of the speculative distance of their pair: what touches a sleeper is as near
// (sleep.h). A wider range than that distance is cut, for contacts are not sure to exist beyond it.
CONSTANT float ATTRACTING = 0.25f;

struct Cohesion {
    float force;  // of a pair, N; 0: none
    float range;  // m
};

// 1 over the radius of a row's body, 1/m; 0: flat.
LAW float curvature_of(BodyProperties row, Surface surface) {
    bool ball = row.shape == SHAPE_SPHERE && !is_part(row);
    return choose(ball, reciprocal(row.size.x), surface.curvature);
}
LAW Cohesion cohesion_between(BodyProperties ta, Surface sa, BodyProperties tb, Surface sb, Parameters parameters) {
    float curvature = curvature_of(ta, sa) + curvature_of(tb, sb), told = larger(sa.cohesion_range, sb.cohesion_range);
    float farthest = speculative_of(ta, tb, parameters);
    float work = square_root(sa.cohesion * sb.cohesion);
    Cohesion found;
    found.force = choose(curvature > 0.0f, (6.2831853f * work) * reciprocal(curvature), 0.0f);
    found.range = choose(told < 0.0f, ATTRACTING * farthest, smaller(told, farthest));
    return found;
}

LAW bool attracts(uint count, vec4 separation, float range, int k) {
    return uint(k) < count && separation[k] <= range;
}
// Points of a contact that attract each other.
LAW float attracting_points(uint count, vec4 separation, float range) {
    float points = 0.0f;
    for (int k = 0; k < 4; ++k) points = points + choose(attracts(count, separation, range, k), 1.0f, 0.0f);
    return points;
}

// What a contact exerts on one of its bodies, at the body's centre of mass, N and N m. `side`: 0 for A, 1 for B. `part`: of the
// pair's force. `va`, `vb`: as the step begins.
LAW Wrench attraction(Constraint c, ContactImpulse impulse, Cohesion cohesion, float part, uint side, Velocity va, Velocity vb,
                      Parameters parameters) {
    vec3 middle = impulse.center_offset + (vb.linear - va.linear) * (0.5f * (parameters.dt - parameters.h));
    c = refresh_round_contact(c, middle);
    float points = attracting_points(point_count(c), impulse.separation, cohesion.range);
    float each = (cohesion.force * part) * reciprocal(larger(points, 1.0f));
    vec3 press = vec3(0.0f);
    for (int k = 0; k < 4; ++k) {
        bool acts = attracts(point_count(c), impulse.separation, cohesion.range, k);
        press = press + press_at(c, choose(acts, -each, 0.0f), k);
    }
    Wrench wrench = wrench_of_press(c, press);
    LeverArms arms = lever_arms(c, c.centre, middle);
    bool on_b = side == 1u;
    wrench.moment = cross3(choose(on_b, arms.b, arms.a), wrench.push) + wrench.moment;
    wrench.push = choose(on_b, wrench.push, vec3(0.0f) - wrench.push);
    wrench.moment = choose(on_b, wrench.moment, vec3(0.0f) - wrench.moment);
    return wrench;
}

// The body's accelerations with what its contacts exert.
LAW BodyForces with_attraction(BodyForces load, Wrench sum, Mass mass) {
    load.acceleration = load.acceleration + flush_tiny(sum.push * mass.inverse_mass);
    load.angular_acceleration = load.angular_acceleration + flush_tiny(turned_by(mass, sum.moment));
    return load;
}

LAWS_END

#endif
