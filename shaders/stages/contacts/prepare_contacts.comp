// Contact preparation: constraints, blocks of contacts, and the first warm start.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/contact_preparation.h"
#include "shaders/stages/lib/contact_blocks.glsl"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/images.glsl"
#include "shaders/stages/lib/impulses.glsl"

Constraint on_tyre_of(BodyProperties ta, BodyProperties tb, Constraint constraint, vec3 d, VelocityPair now) {
    bool is_a = tyre_of(ta) != 0u;
    return on_tyre(constraint, is_a, READ_QUADS(tyres, tyre_of(is_a ? ta : tb) - 1u), d, now);
}

Surface surface_on(BodyProperties row) {
    if (surface_of(row) == 0u) return plain_surface(row);
    return READ_QUADS(surfaces, surface_of(row) - 1u);
}

// The constraint of a contact that some body moves.
Constraint prepared(uint i, Contact contact, uint of_a, uint of_b, VelocityPair now, Image image, Parameters own) {
    BodyProperties ta = READ(properties, contact.a), tb = READ(properties, contact.b);
    uint slot_a = READ_WORD(contact_slots, 2u * i), slot_b = READ_WORD(contact_slots, 2u * i + 1u);
    Constraint constraint = constraint_between(contact, ta, of_a, slot_a, tb, of_b, slot_b, own);
    constraint = with_joints(constraint, READ(properties, of_a).joints, READ(properties, of_b).joints);
    if (PERIODIC) constraint = meeting_image(constraint, image);
    if (SURFACES && (surface_of(ta) | surface_of(tb)) != 0u)
        constraint = with_surfaces(constraint, ta, surface_on(ta), READ(poses, of_a).orientation, tb, surface_on(tb),
                                   READ(poses, of_b).orientation, PARAMETERS);
    if (tyre_of(ta) != 0u || tyre_of(tb) != 0u) constraint = on_tyre_of(ta, tb, constraint, contact.center_offset, now);
    return constraint;
}

// The number of the next contact of a block (contact_block.h).
uint next_in_block(uint i, uint place, bool shares, uint of_a, uint of_b) {
    if (!shares || place + 1u >= BLOCK_CONTACTS) return 0u;
    SlotsOfBody slots = slots_of_pair(of_a, READ_WORD(contact_slots, 2u * i), of_b, READ_WORD(contact_slots, 2u * i + 1u));
    return next_partner(slots, of_a, of_b) + 1u;  // NONE + 1 is 0
}

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts) return;
    Contact contact = READ(contacts, i);
    uint slot_a = READ_WORD(contact_slots, 2u * i), slot_b = READ_WORD(contact_slots, 2u * i + 1u);
    uint of_a = body_of(contact.a), of_b = body_of(contact.b);
    if (is_idle(slot_a, slot_b)) {
        write_constraints(i, idle_between(contact, of_a, of_b), EVERY_MEMBER);
        return;
    }
    bool shares = BLOCKS && shares_block(READ(properties, contact.a), READ(properties, contact.b), PARAMETERS);
    if (shares && follows_another(slots_of_pair(of_a, slot_a, of_b, slot_b), of_a, of_b)) return;
    Parameters own = parameters_of(of_a);
    VelocityPair now;
    now.a = READ(velocities, of_a);
    now.b = READ(velocities, of_b);
    Image image = image_at(vec3(0.0f), PARAMETERS);
    if (PERIODIC) {
        image = image_met(READ(properties, contact.a), of_a, READ(properties, contact.b), of_b);
        now.b = at_image(now.b, image);
    }
    BodyMass mass_a = READ(masses, of_a), mass_b = READ(masses, of_b);
    float of_block = 0.0f;
    uint before = 0u, here = i + 1u, place = 0u;
    do {
        uint k = here - 1u;
        if (place != 0u) contact = READ(contacts, k);
        Constraint constraint = prepared(k, contact, of_a, of_b, now, image, own);
        uint next = next_in_block(k, place, shares, of_a, of_b);
        constraint = linked(constraint, before, next);
        write_constraints(k, constraint, EVERY_MEMBER);
        Impulse impulse = pushes_at(k);
        ContactShare share = first_share(constraint, impulse, now, mass_a, mass_b, own);
        of_block = larger(of_block, share.weight);
        float weight = next == 0u ? of_block : 0.0f;
        if (constraint.slot_a != NONE)
            WRITE(slots, constraint.slot_a, velocity_delta(share.change.a, weight, impulse.normal_sum));
        if (constraint.slot_b != NONE)
            WRITE(slots, constraint.slot_b, velocity_delta(share.change.b, weight, impulse.normal_sum));
        before = here;
        here = next;
        ++place;
    } while (BLOCKS && here != 0u);
}
