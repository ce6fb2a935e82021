// Narrowphase: persistent manifolds with updated separations.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/collide/grid.h"
#include "shaders/physics/contact/persistence.h"
#include "shaders/stages/lib/found_manifolds.glsl"

void main() {
    uint i = thread() + COUNTED.pair_type_first[PAIR_PERSISTENT];
    if (i >= COUNTED.pair_type_first[PAIR_PERSISTENT + 1u]) return;
    uint index = READ_WORD(pairs_by_type, i);
    Pair pair = READ(pairs, index);
    Contact contact = READ(contacts_before, pair.previous);
    keep_manifold(index, persistent_manifold(contact, READ(poses, body_of(pair.a)), READ(poses, body_of(pair.b))), contact.count);
}
