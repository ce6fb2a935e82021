// Finds with which force, and up to which gap, each contact attracts its bodies (shaders/physics/contact/cohesion.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/cohesion.h"
#include "shaders/physics/contact/contact_preparation.h"
#include "shaders/stages/lib/contact_blocks.glsl"

bool is_attracting(uint contact, uint count, float range) {
    return attracting_points(count, READ_GROUPED(impulses, contact).separation, range) > 0.0f;
}

// The part of a pair's force that each of its contacts has which attract the bodies.
float part_of_pair(SlotsOfBody slots, uint of_a, uint of_b, float range) {
    float contacts_there = 0.0f;
    uint k = slots.first;
    do {
        uint side = READ_WORD(slot_sides, k);
        if ((side & OF_JOINT) == 0u) {
            Contact other = READ(contacts, side >> 1);
            bool same = body_of(other.a) == of_a && body_of(other.b) == of_b;
            if (same && is_attracting(side >> 1, other.count, range)) contacts_there = contacts_there + 1.0f;
        }
        ++k;
    } while (k < slots.last);
    return reciprocal(larger(contacts_there, 1.0f));
}

Cohesion cohesion_of(uint i, Contact contact) {
    Cohesion found;
    found.force = 0.0f;
    found.range = 0.0f;
    uint slot_a = READ_WORD(contact_slots, 2u * i), slot_b = READ_WORD(contact_slots, 2u * i + 1u);
    BodyProperties ta = READ(properties, contact.a), tb = READ(properties, contact.b);
    if (is_idle(slot_a, slot_b) || surface_of(ta) == 0u || surface_of(tb) == 0u) return found;
    found = cohesion_between(ta, READ_QUADS(surfaces, surface_of(ta) - 1u), tb, READ_QUADS(surfaces, surface_of(tb) - 1u),
                             PARAMETERS);
    if (!(found.force > 0.0f) || !(is_part(ta) || is_part(tb))) return found;
    uint of_a = body_of(contact.a), of_b = body_of(contact.b);
    found.force = found.force * part_of_pair(slots_of_pair(of_a, slot_a, of_b, slot_b), of_a, of_b, found.range);
    return found;
}

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts) return;
    Cohesion found = cohesion_of(i, READ(contacts, i));
    SET_FLOAT(attractions, 2u * i, found.force);
    SET_FLOAT(attractions, 2u * i + 1u, found.range);
}
