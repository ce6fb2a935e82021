// Narrowphase: manifolds of inactive pairs, unchanged.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/collide/grid.h"
#include "shaders/physics/contact/persistence.h"
#include "shaders/stages/lib/found_manifolds.glsl"
#include "shaders/stages/lib/impulses.glsl"

void main() {
    uint i = thread() + COUNTED.pair_type_first[PAIR_INACTIVE];
    if (i >= COUNTED.pair_type_first[PAIR_INACTIVE + 1u]) return;
    uint index = READ_WORD(pairs_by_type, i);
    uint previous = READ(pairs, index).previous;
    Contact contact = READ(contacts_before, previous);
    keep_manifold(index, resting_manifold(contact, pushes_before(previous)), contact.count);
}
