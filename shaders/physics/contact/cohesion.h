// Cohesion: bodies that touch attract each other, along the normals of their contacts.
//
// Rigid balls that touch hold together with F = 2 pi w R, where w is their work of adhesion and 1/R = 1/R_a + 1/R_b (Bradley,
// Phil. Mag. 13, 1932; so do stiff elastic ones: Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53, 1975). A bridge of
// liquid pulls as much with w = 2 gamma cos(theta) (Rabinovich, Esayanur, Moudgil, Langmuir 21, 2005). A body that is no ball
// has the radius of the ball of its volume; planes, height fields and what else has no volume are flat. The work of a pair is the
// geometric mean (Girifalco, Good, J. Phys. Chem. 61, 1957).
//
// The force is that of the two bodies: the contacts that they have with each other share it, and so do the points of a contact.
// Once a step the gaps tell which points attract: in a substep bodies fall farther than many a range is wide. Direction and place
// follow in each substep. There a contact gives its bodies an impulse together with its warm start: at the same point, along the
// same normal, from the same numbers. So momentum and angular momentum are exact to rounding, as with its other impulses, and the
// passes do not know of cohesion.
#ifndef SCREE_PHYSICS_COHESION_H
#define SCREE_PHYSICS_COHESION_H

#include "shaders/physics/body/body_scale.h"
#include "shaders/physics/contact/contact_solver.h"
#ifndef SCREE_LANES
#include "shaders/physics/contact/material.h"
#endif

LAWS_BEGIN

// Up to which gap bodies attract each other, of the speculative distance of their pair: what touches a sleeper is as near
// (sleep.h). A wider range than that distance is cut, for contacts are not sure to exist beyond it.
CONSTANT float ATTRACTING = 0.25f;

struct Cohesion {
    float force;  // of a pair, N; 0: none
    float range;  // m
};

#ifndef SCREE_LANES  // which find no forces
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
#endif

// What a contact attracts its bodies with in a step.
struct Attraction {
    float force;  // at each of the points, N; 0: none
    uint points;  // bit k: point k attracts
};
LAW bool attracts(uint points, int k) {
    return (points >> uint(k) & 1u) != 0u;
}

#ifndef SCREE_LANES
LAW Attraction no_attraction() {
    Attraction none;
    none.force = 0.0f;
    none.points = 0u;
    return none;
}
// `count`, `separation`: points of the contact.
LAW uint attracting_points(uint count, vec4 separation, float range) {
    uint points = 0u;
    for (int k = 0; k < 4; ++k) points = points | choose(uint(k) < count && separation[k] <= range, 1u << uint(k), 0u);
    return points;
}
// `contacts`: of the pair, with points that attract.
LAW Attraction shared_force(Cohesion cohesion, uint points, float contacts) {
    float sharers = 0.0f;
    for (int k = 0; k < 4; ++k) sharers = sharers + choose(attracts(points, k), contacts, 0.0f);
    Attraction found;
    found.force = choose(points != 0u, cohesion.force * reciprocal(larger(sharers, 1.0f)), 0.0f);
    found.points = points;
    return found;
}
#endif

// What it changes of its bodies' velocities in a substep. `center_offset`: at present.
LAW VelocityPair changes_by_attraction(Constraint c, vec3 center_offset, Attraction attraction, Mass a, Mass b,
                                       Parameters parameters) {
    c = refresh_round_contact(c, center_offset);
    float pull = -(attraction.force * parameters.h);
    vec3 press = vec3(0.0f);
    for (int k = 0; k < 4; ++k) press = press + press_at(c, choose(attracts(attraction.points, k), pull, 0.0f), k);
    return changes_by(wrench_of_press(c, press), lever_arms(c, c.centre, center_offset), a, b);
}

LAW VelocityDelta with_change(VelocityDelta slot, Velocity change) {
    slot.linear = flush_tiny(slot.linear + change.linear);
    slot.angular = flush_tiny(slot.angular + change.angular);
    return slot;
}

LAWS_END

#endif
