// Gives back what bodies that break could not bear: to them, and to those that they touch.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/fracture.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/hulls.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u || COUNTS.broken == 0u) return;
    if (!is_movable(traits.at[i].motion, rests.at[i], PARAMETERS.sleep_steps)) return;
    Velocity velocity = velocities.at[i];
    uint last = slot_ends.at[i];
    for (uint k = i == 0u ? 0u : slot_ends.at[i - 1u]; k < last; ++k) {
        uint contact = slot_sides.at[k] >> 1u;
        Constraint c = constraints.at[contact];
        float kept = smaller(loads.at[c.a].kept, loads.at[c.b].kept);
        float carried = uintBitsToFloat(candidates.at[contact].owner);
        if (!(kept < 1.0f) || !(carried > 0.0f)) continue;
        velocity = given_back(velocity, masses.at[i], c, impulses.at[contact], slot_sides.at[k] & 1u, carried * (1.0f - kept));
    }
    velocities.at[i] = limited(velocity, PARAMETERS);
}
