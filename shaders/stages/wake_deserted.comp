// Wakes sleepers whose contact with a body that stirs is there no more.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/grid.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

// Pairs of an owner are in the order of the other body.
bool owner_touches(uint owner, uint other) {
    uint low = pair_starts.at[owner];
    uint high = pair_starts.at[owner + 1u];
    while (low < high) {
        uint middle = (low + high) >> 1;
        uint partner = pairs.at[middle].a == owner ? pairs.at[middle].b : pairs.at[middle].a;
        if (partner == other) return touching.at[middle] != 0u;
        if (partner < other)
            low = middle + 1u;
        else
            high = middle;
    }
    return false;
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u || COUNTS.sleepers == 0u || !any_stirs(COUNTS)) return;
    bool own_still = (bounds.at[i].level & STILL) != 0u;
    uint last = first_contacts_before.at[i + 1u];
    for (uint k = first_contacts_before.at[i]; k < last; ++k) {
        uint a = contacts_before.at[k].a;
        uint other = a == i ? contacts_before.at[k].b : a;
        if (((bounds.at[other].level & STILL) != 0u) == own_still) continue;
        uint sleeper = own_still ? i : other;
        if (!has_slept(rests.at[sleeper], PARAMETERS.sleep_steps)) continue;
        if (owner_touches(i, other) || owner_touches(other, i)) continue;
        if (load_changed(0.0f, contacts_before.at[k].load, traits.at[sleeper], PARAMETERS)) atomicOr(rests.at[sleeper], WOKEN);
    }
}
