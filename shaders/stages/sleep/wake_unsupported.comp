// Wakes sleepers that have lost a contact with an active body.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/long_ranges.glsl"

// Binary search: pairs of an owner are sorted by the other body's id.
bool owner_touches(uint owner, uint other) {
    uint id = id_of(other);
    uint low = READ_WORD(pair_starts, owner);
    uint high = READ_WORD(pair_starts, owner + 1u);
    while (low < high) {
        uint middle = (low + high) >> 1;
        uint partner = READ(pairs, middle).a == owner ? READ(pairs, middle).b : READ(pairs, middle).a;
        if (partner == other) return has_points(READ_WORD(point_counts, middle));
        if (id_of(partner) < id)
            low = middle + 1u;
        else
            high = middle;
    }
    return false;
}

// A contact of the last step that row i owned.
void look_at(uint k, uint i, bool own_still) {
    uint a = READ(contacts_before, k).a;
    uint other = a == i ? READ(contacts_before, k).b : a;
    if (((READ(bounds, other).level & INACTIVE) != 0u) == own_still) return;
    uint sleeper = body_of(own_still ? i : other);
    if (!has_slept(WORD(sleep_states, sleeper), PARAMETERS.sleep_steps)) return;
    if (owner_touches(i, other) || owner_touches(other, i)) return;
    if (load_changed(0.0f, READ(contacts_before, k).load, READ(properties, sleeper), parameters_of(sleeper)))
        atomicOr(WORD(sleep_states, sleeper), WOKEN);
}

bool is_still(uint i) {
    return (READ(bounds, i).level & INACTIVE) != 0u;
}

void main() {
    if (COUNTED.overflow != 0u || COUNTED.sleepers == 0u || !any_stirs(COUNTED)) return;
    begin_long_ranges();
    uint i = thread();
    if (i < PARAMETERS.bodies) {
        uint first = READ_WORD(first_contacts, i), last = READ_WORD(first_contacts, i + 1u);
        if (last - first > SHORT_RANGE) {
            note_long_range(i);
        } else {
            bool own_still = is_still(i);
            for (uint k = first; k < last; ++k) look_at(k, i, own_still);
        }
    }
    uint noted = long_ranges_noted();
    for (uint n = 0u; n < noted; ++n) {
        uint owner = long_range[n], last = READ_WORD(first_contacts, owner + 1u);
        bool own_still = is_still(owner);
        for (uint k = READ_WORD(first_contacts, owner) + gl_LocalInvocationID.x; k < last; k += gl_WorkGroupSize.x)
            look_at(k, owner, own_still);
    }
}
