// Sorts each body's slots by contact, so that its sum has one order; and says where the contacts it owns begin.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

#define SORT_GET(i) slot_sides.at[i]
#define SORT_SET(i, value) slot_sides.at[i] = value
#include "shaders/stages/sort.glsl"

void main() {
    uint i = thread();
    if (COUNTED.overflow != 0u) return;
    if (i == 0u) first_contacts.at[PARAMETERS.bodies] = COUNTED.contacts;  // even of no bodies
    if (i >= PARAMETERS.bodies) return;
    first_contacts.at[i] = READ(contact_starts, READ(pair_starts, i));
    uint first = i == 0u ? 0u : READ(slot_ends, i - 1u);
    uint count = READ(slot_ends, i) - first;
    sort_range(first, count);
    for (uint k = first; k < first + count; ++k) {
        uint side = slot_sides.at[k];
        if ((side & OF_JOINT) != 0u)
            joints.at[side & ~OF_JOINT].slot = k;
        else if ((side & 1u) == 0u)
            constraints.at[side >> 1].slot_a = k;
        else
            constraints.at[side >> 1].slot_b = k;
    }
}
