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
    Attraction attraction;
    attraction.force = READ_FLOAT(attractions, 2u * i);
    attraction.points = uint(READ_FLOAT(attractions, 2u * i + 1u));
    if (!(attraction.force > 0.0f)) return;
    Constraint c = READ_GROUPED(constraints, i);
    VelocityPair change = changes_by_attraction(c, READ_GROUPED(impulses, i).center_offset, attraction,
                                                whole_mass(READ(masses, c.a)), whole_mass(READ(masses, c.b)), PARAMETERS);
    if (c.slot_a != NONE) WRITE(slots, c.slot_a, with_change(READ(slots, c.slot_a), change.a));
    if (c.slot_b != NONE) WRITE(slots, c.slot_b, with_change(READ(slots, c.slot_b), change.b));
}
