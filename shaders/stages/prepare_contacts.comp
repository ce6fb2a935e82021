// Contact preparation: constraints, inherited impulses, and the first warm start.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/solve/contact_preparation.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/features.glsl"

Constraint on_tyre_of(BodyProperties ta, BodyProperties tb, Constraint constraint, vec3 d, VelocityPair now) {
    bool is_a = tyre_of(ta) != 0u;
    return on_tyre(constraint, is_a, READ_QUADS(tyres, tyre_of(is_a ? ta : tb) - 1u), d, now);
}

Surface surface_on(BodyProperties row) {
    if (surface_of(row) == 0u) return plain_surface(row);
    return READ_QUADS(surfaces, surface_of(row) - 1u);
}

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts) return;
    uint pair_index = constraints.at[i].pair;
    Pair pair = READ(pairs, pair_index);
    uint slot_a = constraints.at[i].slot_a, slot_b = constraints.at[i].slot_b;
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    bool idle = is_idle(slot_a, slot_b);
    PreparedContact prepared;
    if (is_carried_forward(pair.pair_type))
        prepared = carried_forward(READ(contacts_before, pair.previous), READ(impulses_before, pair.previous),
                                   READ(manifolds, pair_index));
    if (idle && pair.pair_type == PAIR_INACTIVE) {
        contacts.at[i] = prepared.contact;
        impulses.at[i] = prepared.impulse;
        constraints.at[i] = idle_between(prepared.contact, of_a, of_b);
        return;
    }
    BodyProperties ta = READ(properties, pair.a), tb = READ(properties, pair.b);
    if (!is_carried_forward(pair.pair_type)) {
        prepared = newly_found(pair, READ(manifolds, pair_index), READ_WORD(point_counts, pair_index), READ(poses, of_a),
                               READ(poses, of_b));
        if (pair.previous != NONE)
            prepared = warm_started(prepared, READ(contacts_before, pair.previous), READ(impulses_before, pair.previous), ta, tb);
    }
    if (pair.previous != NONE)
        prepared.contact.load =
            load_since(READ(contacts_before, pair.previous), READ(impulses_before, pair.previous), ta, slot_a, tb, slot_b);
    if (!idle) prepared.impulse.normal_sum = normal_impulse(prepared.impulse);
    impulses.at[i] = prepared.impulse;
    if (idle) {
        contacts.at[i] = prepared.contact;
        constraints.at[i] = idle_between(prepared.contact, of_a, of_b);
        return;
    }
    Parameters felt = felt_by(of_a);
    Constraint constraint = constraint_between(prepared.contact, pair_index, ta, of_a, slot_a, tb, of_b, slot_b, felt);
    if (SURFACES && (surface_of(ta) | surface_of(tb)) != 0u)
        constraint = with_surfaces(constraint, ta, surface_on(ta), READ(poses, of_a).orientation, tb, surface_on(tb),
                                   READ(poses, of_b).orientation, PARAMETERS);
    VelocityPair now;
    now.a = READ(velocities, of_a);
    now.b = READ(velocities, of_b);
    if (tyre_of(ta) != 0u || tyre_of(tb) != 0u) constraint = on_tyre_of(ta, tb, constraint, prepared.contact.center_offset, now);
    if (BOUNCES && pair.previous != NONE && rebounds_across(prepared.impulse)) {
        Constraint before = constraint_of(READ(contacts_before, pair.previous), ta, tb, slot_a, slot_b, felt);
        prepared.impulse = settled_impact(prepared.impulse, constraint, READ(impulses_before, pair.previous), before, now);
        impulses.at[i].rebound_energy = prepared.impulse.rebound_energy;
    }
    prepared.contact.unrest = unrest_of(prepared.contact, constraint, ta, tb, now, felt);
    contacts.at[i] = prepared.contact;
    constraint = with_unrest(constraint, prepared.contact.unrest);
    constraints.at[i] = constraint;

    ContactShare share = first_share(constraint, prepared.impulse, now, READ(masses, of_a), READ(masses, of_b), felt);
    float normal_sum = prepared.impulse.normal_sum;
    if (slot_a != NONE) slots.at[slot_a] = velocity_delta(share.change.a, share.weight, normal_sum);
    if (slot_b != NONE) slots.at[slot_b] = velocity_delta(share.change.b, share.weight, normal_sum);
}
