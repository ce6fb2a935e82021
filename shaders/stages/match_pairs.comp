// Puts each body's pairs in the order of the other body, finds their contacts in the last step and says which kernel they need.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/persistence.h"
#include "shaders/stages/stage.glsl"

// The contacts that a body owned are in the order of the other body.
uint contact_before(uint owner, uint other) {
    uint low = first_contacts_before.at[owner];
    uint high = first_contacts_before.at[owner + 1u];
    while (low < high) {
        uint middle = (low + high) >> 1;
        uint a = contacts_before.at[middle].a;
        uint partner = a == owner ? contacts_before.at[middle].b : a;
        if (partner == other) return middle;
        if (partner < other)
            low = middle + 1u;
        else
            high = middle;
    }
    return NONE;
}

void main() {
    uint i = thread();
    if (i >= COUNTS.pairs) return;
    Candidate candidate = candidates.at[i];
    uint place = pair_starts.at[candidate.owner];
    uint last = pair_starts.at[candidate.owner + 1u];
    for (uint k = place; k < last; ++k)
        if (candidates.at[k].other < candidate.other) ++place;
    Pair pair = Pair(min(candidate.owner, candidate.other), max(candidate.owner, candidate.other), 0u, NONE);
    // Bodies change level with their speed, and then the other one owns the pair.
    pair.previous = contact_before(pair.a, pair.b);
    if (pair.previous == NONE) pair.previous = contact_before(pair.b, pair.a);
    if ((bounds.at[pair.a].level & bounds.at[pair.b].level & STILL) != 0u) {
        pair.kind = KIND_STILL;
    } else {
        Traits ta = traits.at[pair.a], tb = traits.at[pair.b];
        uint of_a = body_of(pair.a), of_b = body_of(pair.b);
        bool kept = false;
        if (pair.previous != NONE && has_weight(PARAMETERS))
            kept = is_kept(contacts_before.at[pair.previous], impulses_before.at[pair.previous], ta, poses.at[of_a],
                           velocities.at[of_a], tb, poses.at[of_b], velocities.at[of_b]);
        pair.kind = kept ? KIND_KEPT : kind_of(ta.shape, tb.shape);
    }
    pairs.at[place] = pair;
}
