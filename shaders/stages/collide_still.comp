// Carries over the manifolds of pairs that do not stir.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/collide/grid.h"
#include "shaders/physics/solve/persistence.h"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread() + COUNTED.kind_first[KIND_STILL];
    if (i >= COUNTED.kind_first[KIND_STILL + 1u]) return;
    uint index = READ_WORD(pairs_by_kind, i);
    uint previous = READ(pairs, index).previous;
    Contact contact = READ(contacts_before, previous);
    manifolds.at[index] = resting_manifold(contact, READ(impulses_before, previous));
    WORD(touching, index) = contact.count;
}
