// Finds each pair's contact in the last step and says which kernel it needs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/persistence.h"
#include "shaders/stages/stage.glsl"

// The contacts that a body owned are in the order of the other body.
uint contact_before(uint owner, uint other) {
    uint low = first_contacts_before[owner];
    uint high = first_contacts_before[owner + 1u];
    while (low < high) {
        uint middle = (low + high) >> 1;
        uint a = contacts_before[middle].a;
        uint partner = a == owner ? contacts_before[middle].b : a;
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
    Pair pair = pairs[i];
    // Bodies change level with their speed, and then the other one owns the pair.
    uint previous = contact_before(pair.a, pair.b);
    if (previous == NONE) previous = contact_before(pair.b, pair.a);
    pairs[i].previous = previous;
    Traits ta = traits[pair.a], tb = traits[pair.b];
    bool kept = false;
    if (previous != NONE)
        kept = is_kept(contacts_before[previous], impulses_before[previous], ta, poses[pair.a], velocities[pair.a], tb,
                       poses[pair.b], velocities[pair.b]);
    pairs[i].kind = kept ? KIND_KEPT : kind_of(ta.shape, tb.shape);
}
