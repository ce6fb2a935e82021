// Contact preparation: warm starting across steps, the constraint, and the first warm start of a step.
#ifndef SCREE_PHYSICS_CONTACT_PREPARATION_H
#define SCREE_PHYSICS_CONTACT_PREPARATION_H

#include "shaders/physics/collide/grid.h"
#include "shaders/physics/contact/carried_contact.h"
#include "shaders/physics/contact/contact.h"
#include "shaders/physics/contact/contact_constraint.h"
#include "shaders/physics/contact/contact_solver.h"
#include "shaders/physics/contact/material.h"
#include "shaders/physics/contact/persistence.h"
#include "shaders/physics/contact/tyre.h"

LAWS_BEGIN

struct PreparedContact {
    Contact contact;
    Impulse impulse;
};

// A contact between bodies that the solver does not move in this step.
LAW bool is_idle(uint slot_a, uint slot_b) {
    return slot_a == NONE && slot_b == NONE;
}

// A persistent contact: geometry and impulses of the last step, separations of this one.
LAW PreparedContact carried_forward(Contact before, Impulse was, Manifold manifold) {
    PreparedContact prepared;
    prepared.contact = before;
    prepared.impulse = carried_impulse(before, was, manifold);
    return prepared;
}
// A contact made in this step.
LAW PreparedContact without_impulses(Contact contact) {
    PreparedContact prepared;
    prepared.contact = contact;
    prepared.impulse = no_impulse(contact.center_offset);
    prepared.impulse.separation = separations_of(contact);
    return prepared;
}

// Warm starting across steps: impulses are taken from the points of last step's contact that match.
LAW PreparedContact warm_started(PreparedContact prepared, Contact before, Impulse was, BodyProperties a, BodyProperties b) {
    uvec4 matches;
    if (tyre_of(a) != 0u || tyre_of(b) != 0u)
        matches = matches_of_tyre(prepared.contact, before, tyre_of(a) != 0u, smaller(min_half_width(a), min_half_width(b)));
    else
        matches = matches_of(prepared.contact, before, match_radius(prepared.contact, before, a, b));
    vec4 separation = prepared.impulse.separation;
    prepared.impulse = warm_start_from(prepared.contact, was, matches, keeps_twist(before, a, b));
    prepared.impulse.separation = separation;
    return prepared;
}

LAW Constraint idle_between(Contact contact, uint body_a, uint body_b) {
    Constraint c = idle_constraint(contact);
    c.a = body_a;
    c.b = body_b;
    return c;
}
// Half the sum of the last impulses of an impact times the present velocities, J.
LAW float impact_work(Constraint c, vec4 impact, vec3 center_offset, VelocityPair now) {
    c = refresh_round_contact(c, center_offset);
    vec3 speeds = normal_speeds(c, center_offset, now);
    float work = 0.0f;
    for (int k = 0; k < 4; ++k)
        if (uint(k) < point_count(c) && impact[k] > 0.0f) work = work + 0.5f * (impact[k] * speed_at(c, speeds, k));
    return work;
}
// An impact that lasts from the last step, whose last impulses did their work along the rows of that step, `before`: the
// first biased pass takes the present rows, `c`. They differ where bodies were clamped to a time of impact.
LAW Impulse settled_impact(Impulse impulse, Constraint c, Impulse was, Constraint before, VelocityPair now) {
    if (was.speed_before_push != 0.0f) return impulse;  // on joints: the work is known by the velocities that are reached
    float work =
        impact_work(c, impulse.impact, impulse.center_offset, now) - impact_work(before, was.impact, was.center_offset, now);
    impulse.rebound_energy = flush_least(impulse.rebound_energy + work);
    return impulse;
}

// The contact's contribution before the first substep: its warm start, and 1 if it is active (counts in mass
// splitting).
struct ContactShare {
    VelocityPair change;
    float weight;
};
LAW ContactShare first_share(Constraint c, Impulse impulse, VelocityPair now, BodyMass a, BodyMass b, Parameters parameters) {
    ContactShare share;
    share.weight = is_active(c, impulse, now, parameters);
    share.change = warm_start(c, impulse, whole_mass(a), whole_mass(b));
    return share;
}

LAWS_END

#endif
