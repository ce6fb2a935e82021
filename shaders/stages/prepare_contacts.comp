// Contact preparation: constraints, and the first warm start.
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
    Contact contact = READ(contacts, i);
    uint slot_a = READ_WORD(contact_slots, 2u * i), slot_b = READ_WORD(contact_slots, 2u * i + 1u);
    uint of_a = body_of(contact.a), of_b = body_of(contact.b);
    if (is_idle(slot_a, slot_b)) {
        constraints.at[i] = idle_between(contact, of_a, of_b);
        return;
    }
    BodyProperties ta = READ(properties, contact.a), tb = READ(properties, contact.b);
    Parameters felt = felt_by(of_a);
    Constraint constraint = constraint_between(contact, ta, of_a, slot_a, tb, of_b, slot_b, felt);
    if (SURFACES && (surface_of(ta) | surface_of(tb)) != 0u)
        constraint = with_surfaces(constraint, ta, surface_on(ta), READ(poses, of_a).orientation, tb, surface_on(tb),
                                   READ(poses, of_b).orientation, PARAMETERS);
    VelocityPair now;
    now.a = READ(velocities, of_a);
    now.b = READ(velocities, of_b);
    if (tyre_of(ta) != 0u || tyre_of(tb) != 0u) constraint = on_tyre_of(ta, tb, constraint, contact.center_offset, now);
    float unrest = unrest_of(contact, constraint, ta, tb, now, felt);
    contacts.at[i].unrest = unrest;
    constraint = with_unrest(constraint, unrest);
    constraints.at[i] = constraint;

    Impulse impulse = READ(impulses, i);
    ContactShare share = first_share(constraint, impulse, now, READ(masses, of_a), READ(masses, of_b), felt);
    if (slot_a != NONE) slots.at[slot_a] = velocity_delta(share.change.a, share.weight, impulse.normal_sum);
    if (slot_b != NONE) slots.at[slot_b] = velocity_delta(share.change.b, share.weight, impulse.normal_sum);
}
