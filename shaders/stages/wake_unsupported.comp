// Wakes sleepers that have lost a contact with an active body.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/extra/sleep.h"
#include "shaders/stages/lib/copies.glsl"

// Binary search: pairs of an owner are sorted by the other body's id.
bool owner_touches(uint owner, uint other) {
    uint id = id_of(other);
    uint low = READ_WORD(pair_starts, owner);
    uint high = READ_WORD(pair_starts, owner + 1u);
    while (low < high) {
        uint middle = (low + high) >> 1;
        uint partner = READ(pairs, middle).a == owner ? READ(pairs, middle).b : READ(pairs, middle).a;
        if (partner == other) return READ_WORD(point_counts, middle) != 0u;
        if (id_of(partner) < id)
            low = middle + 1u;
        else
            high = middle;
    }
    return false;
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u || COUNTED.sleepers == 0u || !any_stirs(COUNTED)) return;
    bool own_still = (READ(bounds, i).level & INACTIVE) != 0u;
    uint last = READ_WORD(first_contacts, i + 1u);
    for (uint k = READ_WORD(first_contacts, i); k < last; ++k) {
        uint a = READ(contacts_before, k).a;
        uint other = a == i ? READ(contacts_before, k).b : a;
        if (((READ(bounds, other).level & INACTIVE) != 0u) == own_still) continue;
        uint sleeper = body_of(own_still ? i : other);
        if (!has_slept(WORD(sleep_states, sleeper), PARAMETERS.sleep_steps)) continue;
        if (owner_touches(i, other) || owner_touches(other, i)) continue;
        if (load_changed(0.0f, READ(contacts_before, k).load, READ(properties, sleeper), felt_by(sleeper)))
            atomicOr(WORD(sleep_states, sleeper), WOKEN);
    }
}
