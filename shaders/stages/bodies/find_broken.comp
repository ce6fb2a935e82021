// Fracture: marks bodies that break in this step, and the part of their contacts' impulses that stays.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/fracture/fracture.h"
#include "shaders/stages/lib/copies.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u) return;
    BodyProperties body = READ(properties, i);
    if (!may_break(body) || is_foreign(body)) return;
    float blow = 0.0f;
    uint last = READ_WORD(slot_ends, i);
    for (uint k = i == 0u ? 0u : READ_WORD(slot_ends, i - 1u); k < last; ++k)
        if ((READ_WORD(slot_sides, k) & OF_JOINT) == 0u) blow = larger(blow, READ_FLOAT(carried, READ_WORD(slot_sides, k) >> 1u));
    Fracturing fracturing = READ_QUADS(fractures, body.fracture);
    float kept = kept_part(fracturing, blow, READ_FLOAT(strains, i));
    SET_FLOAT(strains, i, strain_after(fracturing, blow, body, READ(velocities, i)));
    if (!(kept < 1.0f)) return;
    forces.at[i].kept = kept;
    atomicAdd(COUNTS.broken, 1u);
    if (COPIES) atomicOr(WORD(copy_states, copy_of(i)), COPY_BREAKS);
}
