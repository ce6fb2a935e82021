// Adds what contacts attract their bodies with to the changes with which these begin a substep
// (shaders/physics/contact/cohesion.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/cohesion.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint place = thread();
    if (place >= COUNTED.solver_contacts) return;
    uint i = READ_WORD(contacts_to_solve, place);
    Cohesion cohesion;
    cohesion.force = READ_FLOAT(attractions, 2u * i);
    cohesion.range = READ_FLOAT(attractions, 2u * i + 1u);
    if (!(cohesion.force > 0.0f)) return;
    ContactImpulse impulse = READ_GROUPED(impulses, i);
    Constraint c = READ_GROUPED(constraints, i);
    if (!(attracting_points(point_count(c), impulse.separation, cohesion.range) > 0.0f)) return;
    VelocityPair change = attraction(c, impulse.separation, impulse.center_offset, cohesion, whole_mass(READ(masses, c.a)),
                                     whole_mass(READ(masses, c.b)), PARAMETERS);
    if (c.slot_a != NONE) WRITE(slots, c.slot_a, with_change(READ(slots, c.slot_a), change.a));
    if (c.slot_b != NONE) WRITE(slots, c.slot_b, with_change(READ(slots, c.slot_b), change.b));
}
