// The two passes of a substep over one contact. Plain loops, SIMD lanes and devices read a contact with its bodies, call one of
// these, and write what it returns.
#ifndef SCREE_PHYSICS_CONTACT_PASS_H
#define SCREE_PHYSICS_CONTACT_PASS_H

#include "shaders/physics/contact/contact_solver.h"
#ifndef SCREE_LANES
#include "shaders/physics/contact/contact_block.h"
#endif

LAWS_BEGIN

// The two bodies of a block of contacts in a pass.
struct BlockBodies {
    Mass a, b;           // split
    VelocityPair moved;  // of the whole bodies as the pass begins
    float part;          // of the stiffness that each penetrating point has (contact_block.h); 1 for a contact by itself
};
struct BiasedOutcome {
    Impulse impulse;        // that the contact keeps
    VelocityPair velocity;  // of the split bodies, for the next contact of the block
    VelocityPair share;     // change of the whole bodies' velocities
    float impact_weight;    // among the impacts of its bodies, N s
    float debt;             // impact_debt(), J
};
struct RelaxOutcome {
    Impulse impulse;        // with which the next substep begins
    VelocityPair velocity;  // of the split bodies, for the next contact of the block
    VelocityPair share;     // change of the whole bodies' velocities, with the next substep's warm start
    float counts;           // 1 if it counts in the mass splitting of the next substep, else 0
    float normal_sum;       // of `impulse`, N s
    float borne;            // normal impulse of this pass, impacts included, N s
};

#ifndef SCREE_LANES  // lanes take single contacts, and read less
// The bodies of a block that has such a load. `first`: the impulse of the contact with which the pass begins.
LAW BlockBodies biased_bodies(BodyMass a, BodyMass b, Impulse first, BlockLoad load, VelocityPair v, Parameters parameters) {
    first.normal_sum = load.normal_sum;
    BlockBodies bodies;
    bodies.a = split_mass(a, first, parameters);
    bodies.b = split_mass(b, first, parameters);
    bodies.moved = v;
    bodies.part = part_of_stiffness(load);
    return bodies;
}
// In the relax pass, where a struck body is split among its impacts.
LAW BlockBodies relax_bodies(BodyMass a, BodyForces load_a, BodyMass b, BodyForces load_b, Impulse first, BlockLoad load,
                             VelocityPair v, Parameters parameters) {
    first.normal_sum = load.normal_sum;
    BlockBodies bodies;
    bodies.a = impact_mass(first, a, load_a, parameters);
    bodies.b = impact_mass(first, b, load_b, parameters);
    bodies.moved = v;
    bodies.part = part_of_stiffness(load);
    return bodies;
}
#endif

// The biased pass. `v`: of the split bodies.
LAW BiasedOutcome biased_pass(Constraint c, Impulse impulse, VelocityPair v, BlockBodies bodies, ImpactContext around,
                              Parameters parameters) {
    SolveResult after = solve_contact(c, impulse, v, bodies.a, bodies.b, around, bodies.part, parameters);
    c = refresh_round_contact(c, after.impulse.center_offset);
    BiasedOutcome outcome;
    outcome.impulse = after.impulse;
    outcome.velocity = after.pair_velocity;
    outcome.share = changes_after(c, after, after.impulse, false, bodies.a, bodies.b);
    outcome.impact_weight = after.impulse.impact_weight;
    outcome.debt = impact_debt(after.impulse);
    return outcome;
}

// The relax pass. `last`: in the last substep of a step, whose impulses the next step takes up.
LAW RelaxOutcome relax_pass(Constraint c, Impulse impulse, VelocityPair v, BlockBodies bodies, ImpactContext around, bool last,
                            Parameters parameters) {
    SolveResult after = relax_contact(c, impulse, bodies.moved, v, bodies.a, bodies.b, around, bodies.part, parameters);
    c = refresh_round_contact(c, after.impulse.center_offset);
    RelaxOutcome outcome;
    outcome.borne = normal_impulse(after.impulse);
    outcome.impulse = clear_impacts(after.impulse, point_count(c));
    for (int k = 0; k < 4; ++k) outcome.impulse.normal[k] = choose(after.restarts[k] > 0.0f, 0.0f, outcome.impulse.normal[k]);
    outcome.impulse.normal_sum = normal_impulse(outcome.impulse);
    outcome.velocity = after.pair_velocity;
    outcome.share = changes_after(c, after, outcome.impulse, !last, bodies.a, bodies.b);
    outcome.counts = counts_next(c, impulse, outcome.impulse, after.speeds, parameters);
    outcome.normal_sum = outcome.impulse.normal_sum;
    return outcome;
}

LAWS_END

#endif
