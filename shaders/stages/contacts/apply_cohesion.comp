// Adds the accelerations by what a body's contacts attract it with (shaders/physics/contact/cohesion.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/cohesion.h"
#include "shaders/stages/lib/contact_blocks.glsl"
#include "shaders/stages/lib/features.glsl"

Cohesion cohesion_of(BodyProperties ta, BodyProperties tb) {
    Cohesion none_at_all;
    none_at_all.force = 0.0f;
    none_at_all.range = 0.0f;
    if (surface_of(ta) == 0u || surface_of(tb) == 0u) return none_at_all;
    return cohesion_between(ta, READ_QUADS(surfaces, surface_of(ta) - 1u), tb, READ_QUADS(surfaces, surface_of(tb) - 1u),
                            PARAMETERS);
}

// The part of a pair's force that each of its contacts has which attract the bodies.
float part_of_pair(Constraint c, float range) {
    SlotsOfBody slots = slots_of_pair(c.a, c.slot_a, c.b, c.slot_b);
    float contacts_there = 0.0f;
    uint k = slots.first;
    do {
        uint side = READ_WORD(slot_sides, k);
        if ((side & OF_JOINT) == 0u) {
            Contact other = READ(contacts, side >> 1);
            bool same = body_of(other.a) == c.a && body_of(other.b) == c.b;
            if (same && attracting_points(other.count, READ_GROUPED(impulses, side >> 1).separation, range) > 0.0f)
                contacts_there = contacts_there + 1.0f;
        }
        ++k;
    } while (k < slots.last);
    return reciprocal(larger(contacts_there, 1.0f));
}

Wrench attraction_in(uint side) {
    Wrench exerted;
    exerted.push = vec3(0.0f);
    exerted.moment = vec3(0.0f);
    uint contact = side >> 1;
    Contact between = READ(contacts, contact);
    BodyProperties ta = READ(properties, between.a), tb = READ(properties, between.b);
    Cohesion cohesion = cohesion_of(ta, tb);
    if (!(cohesion.force > 0.0f)) return exerted;
    ContactImpulse impulse = READ_GROUPED(impulses, contact);
    if (!(attracting_points(between.count, impulse.separation, cohesion.range) > 0.0f)) return exerted;
    Constraint c = READ_GROUPED(constraints, contact);
    float part = 1.0f;
    if (is_part(ta) || is_part(tb)) part = part_of_pair(c, cohesion.range);
    return attraction(c, impulse, cohesion, part, side & 1u, READ(velocities, c.a), READ(velocities, c.b), PARAMETERS);
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.first_part || COUNTED.overflow != 0u) return;
    uint k = i == 0u ? 0u : READ_WORD(slot_ends, i - 1u), last = READ_WORD(slot_ends, i);
    if (k >= last || is_foreign(READ(properties, i))) return;
    Wrench sum;
    sum.push = vec3(0.0f);
    sum.moment = vec3(0.0f);
    do {
        uint side = READ_WORD(slot_sides, k);
        if ((side & OF_JOINT) == 0u) sum = plus(sum, attraction_in(side));
        ++k;
    } while (k < last);
    WRITE(forces, i, with_attraction(READ(forces, i), sum, whole_mass(READ(masses, i))));
}
