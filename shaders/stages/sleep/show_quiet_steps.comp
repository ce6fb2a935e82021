// After the last substep: the quiet steps of either body of a contact, for the other's sleep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/constraint/surface.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/grouped.glsl"

float quiet_steps_of(uint body) {
    return quiet_steps_shown(READ(properties, body).motion, READ(velocities, body), READ_WORD(sleep_states, body));
}

void main() {
    uint place = thread();
    if (place >= COUNTED.solver_contacts || PARAMETERS.sleep_steps == NO_SLEEP) return;
    Constraint c = READ_GROUPED(constraints, READ_WORD(contacts_to_solve, place));
    float quiet_a = quiet_steps_of(c.a), quiet_b = quiet_steps_of(c.b);
    if (SURFACES && is_driven(c)) quiet_a = quiet_b = BESIDE_MOVING;
    if (c.slot_a != NONE) SET_FLOAT(neighbours_quiet, c.slot_a, quiet_b);
    if (c.slot_b != NONE) SET_FLOAT(neighbours_quiet, c.slot_b, quiet_a);
}
