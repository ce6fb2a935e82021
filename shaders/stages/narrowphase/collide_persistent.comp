// Narrowphase: persistent manifolds with updated separations.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/collide/grid.h"
#include "shaders/physics/contact/persistence.h"
#include "shaders/stages/lib/found_manifolds.glsl"
#include "shaders/stages/lib/images.glsl"

void main() {
    uint i = thread() + COUNTED.pair_type_first[PAIR_PERSISTENT];
    if (i >= COUNTED.pair_type_first[PAIR_PERSISTENT + 1u]) return;
    uint index = READ_WORD(pairs_by_type, i);
    Pair pair = READ(pairs, index);
    Contact contact = READ(contacts_before, pair.previous);
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    Pose pose_b = READ(poses, of_b);
    if (PERIODIC) pose_b = at_image(pose_b, image_met(READ(properties, pair.a), of_a, READ(properties, pair.b), of_b));
    keep_manifold(index, persistent_manifold(contact, READ(poses, of_a), pose_b), contact.count);
}
