// Finds at which points, and with which force, each contact attracts its bodies (shaders/physics/contact/cohesion.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/cohesion.h"
#include "shaders/physics/contact/contact_preparation.h"
#include "shaders/stages/lib/contact_blocks.glsl"

uint attracting_points_of(uint contact, uint count, float range) {
    return attracting_points(count, READ_GROUPED(impulses, contact).separation, range);
}

// Contacts of a pair of bodies that attract them.
float attracting_contacts(SlotsOfBody slots, uint of_a, uint of_b, float range) {
    float found = 0.0f;
    uint k = slots.first;
    do {
        uint side = READ_WORD(slot_sides, k);
        if ((side & OF_JOINT) == 0u) {
            Contact other = READ(contacts, side >> 1);
            bool same = body_of(other.a) == of_a && body_of(other.b) == of_b;
            if (same && attracting_points_of(side >> 1, other.count, range) != 0u) found = found + 1.0f;
        }
        ++k;
    } while (k < slots.last);
    return found;
}

Attraction attraction_of(uint i, Contact contact) {
    uint slot_a = READ_WORD(contact_slots, 2u * i), slot_b = READ_WORD(contact_slots, 2u * i + 1u);
    BodyProperties ta = READ(properties, contact.a), tb = READ(properties, contact.b);
    if (is_idle(slot_a, slot_b) || surface_of(ta) == 0u || surface_of(tb) == 0u) return no_attraction();
    Cohesion cohesion = cohesion_between(ta, READ_QUADS(surfaces, surface_of(ta) - 1u), tb,
                                         READ_QUADS(surfaces, surface_of(tb) - 1u), PARAMETERS);
    if (!(cohesion.force > 0.0f)) return no_attraction();
    uint points = attracting_points_of(i, contact.count, cohesion.range);
    float contacts_there = 1.0f;
    if (points != 0u && (is_part(ta) || is_part(tb))) {
        uint of_a = body_of(contact.a), of_b = body_of(contact.b);
        contacts_there = attracting_contacts(slots_of_pair(of_a, slot_a, of_b, slot_b), of_a, of_b, cohesion.range);
    }
    return shared_force(cohesion, points, contacts_there);
}

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts) return;
    Attraction found = attraction_of(i, READ(contacts, i));
    SET_FLOAT(attractions, 2u * i, found.force);
    SET_FLOAT(attractions, 2u * i + 1u, float(found.points));
}
