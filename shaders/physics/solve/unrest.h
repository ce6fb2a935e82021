// Unrest of contacts: how long the points of a contact have not been calm, and what a restless contact loses.
//
// With the smaller leak a mechanism of bodies that touch at a corner or an edge may rock for ever: in one of five piles of
// 10,000 boxes of 1 m two boxes under the load of ten did, at 25 to 70 mm/s, and were at rest 20 steps after the full leak
// was back. So a contact whose points have not been calm for PATIENCE has the full leak until it has been calm for long.
// Switched more often than a body rocks (by the points that bear, or by their speed) the leak itself feeds the motion, and
// the pile never rests. Of the five piles all rest then, at 0.04 to 0.06 mm/s; stacks are the same to the last bit.
#ifndef SCREE_PHYSICS_UNREST_H
#define SCREE_PHYSICS_UNREST_H

#include "shaders/physics/solve/jacobian.h"

LAWS_BEGIN

CONSTANT float PATIENCE = 4.0f;        // s; with 1 s a pile takes 2 s longer to rest after a blow
CONSTANT float LONGEST_UNREST = 9.0f;  // s; with 5 s some contacts are restless again and again
CONSTANT float CALMING = 0.25f;        // of the time in which a contact is calm, by which its unrest falls
CONSTANT float CALM_SPEED = 0.25f;     // of what gravity adds to a speed in a substep
CONSTANT float CALM_STRETCH = 0.05f;   // of the smaller half width, per second: limit of small bodies

// Greatest speed of a calm contact's points along the normal, m/s. `half_width`: the smaller one of both bodies, m.
LAW float calm_speed(float half_width, Parameters parameters) {
    return smaller(CALM_SPEED * length3(parameters.gravity) * parameters.h, CALM_STRETCH * half_width);
}
// A contact's unrest at the start of a step, s. `before`: in the last step; `v`: of both bodies.
LAW float unrest_after(float before, Constraint c, vec3 center_offset, VelocityPair v, float calm, Parameters parameters) {
    float fastest = 0.0f;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < point_count(c);
        if (none(there)) break;
        float speed = normal_speed(c, lever_arm(c, k), center_offset, v);
        fastest = choose(there, larger(fastest, abs(speed)), fastest);
    }
    float calmer = positive(before - CALMING * parameters.dt), longer = before + parameters.dt;
    return choose(fastest < calm, calmer, choose(longer < PATIENCE, longer, LONGEST_UNREST));
}
LAW bool is_restless_contact(float unrest) {
    return unrest >= PATIENCE;
}

LAWS_END

#endif
