// Cohesion: bodies that touch attract each other, along the normals of their contacts.
//
// Rigid balls that touch hold together with F = 2 pi w R, where w is their work of adhesion and 1/R = 1/R_a + 1/R_b (Bradley,
// Phil. Mag. 13, 1932; so do stiff elastic ones: Derjaguin, Muller, Toporov, J. Colloid Interface Sci. 53, 1975). A bridge of
// liquid pulls as much with w = 2 gamma cos(theta) (Rabinovich, Esayanur, Moudgil, Langmuir 21, 2005). A body that is no ball
// has the radius of the ball of its volume; planes, height fields and what else has no volume are flat. The work of a pair is the
// geometric mean (Girifalco, Good, J. Phys. Chem. 61, 1957).
//
// The force is that of the two bodies: the contacts that they have with each other share it, as the gaps are when a step begins,
// and so do the points of a contact that are within the range when a substep begins. A contact gives its bodies the impulse with
// which they begin the substep together with its warm start: at the same point, along the same normal, from the same numbers. So
// momentum and angular momentum are exact to rounding, as with its other impulses, and the passes do not know of cohesion.
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

LAW bool attracts(uint count, vec4 separation, float range, int k) {
    return uint(k) < count && separation[k] <= range;
}
// Points of a contact that attract each other.
LAW float attracting_points(uint count, vec4 separation, float range) {
    float points = 0.0f;
    for (int k = 0; k < 4; ++k) points = points + choose(attracts(count, separation, range, k), 1.0f, 0.0f);
    return points;
}

// What the attraction of a contact changes of its bodies' velocities in a substep. `separation`, `center_offset`: at present.
LAW VelocityPair attraction(Constraint c, vec4 separation, vec3 center_offset, Cohesion cohesion, Mass a, Mass b,
                            Parameters parameters) {
    c = refresh_round_contact(c, center_offset);
    float points = attracting_points(point_count(c), separation, cohesion.range);
    float each = (cohesion.force * parameters.h) * reciprocal(larger(points, 1.0f));
    vec3 press = vec3(0.0f);
    for (int k = 0; k < 4; ++k) {
        bool acts = attracts(point_count(c), separation, cohesion.range, k);
        press = press + press_at(c, choose(acts, -each, 0.0f), k);
    }
    return changes_by(wrench_of_press(c, press), lever_arms(c, c.centre, center_offset), a, b);
}

LAW VelocityDelta with_change(VelocityDelta slot, Velocity change) {
    slot.linear = flush_tiny(slot.linear + change.linear);
    slot.angular = flush_tiny(slot.angular + change.angular);
    return slot;
}

LAWS_END

#endif
