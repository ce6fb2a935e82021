// Fracture: returns the impulses that breaking bodies could not bear, to both bodies of each contact.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/fracture/fracture.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/impulses.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || COUNTED.broken == 0u) return;
    if (!is_movable(READ(properties, i).motion, READ_WORD(sleep_states, i), PARAMETERS.sleep_steps)) return;
    if (COPIES && (READ_WORD(copy_states, copy_of(i)) & COPY_BREAKS) == 0u) return;
    Velocity velocity = velocities.at[i];
    uint last = READ_WORD(slot_ends, i);
    for (uint k = i == 0u ? 0u : READ_WORD(slot_ends, i - 1u); k < last; ++k) {
        if ((READ_WORD(slot_sides, k) & OF_JOINT) != 0u) continue;
        uint contact = READ_WORD(slot_sides, k) >> 1u;
        Constraint c = READ_GROUPED(constraints, contact);
        float kept = smaller(READ(forces, c.a).kept, READ(forces, c.b).kept);
        float impulse = READ_FLOAT(carried, contact);
        if (!(kept < 1.0f) || !(impulse > 0.0f)) continue;
        velocity = given_back(velocity, whole_mass(READ(masses, i)), c, pushes_at(contact), READ_WORD(slot_sides, k) & 1u,
                              impulse * (1.0f - kept));
    }
    WRITE(velocities, i, clamp_velocity(velocity, PARAMETERS));
}
