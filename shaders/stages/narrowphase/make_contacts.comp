// Makes a contact of each pair with points: last step's if the pair persists, else a new one. It has no impulses and no
// slots yet.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/contact_preparation.h"
#include "shaders/stages/lib/found_manifolds.glsl"
#include "shaders/stages/lib/ids.glsl"
#include "shaders/stages/lib/images.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs) return;
    uint points = READ_WORD(point_counts, i);
    if (!has_points(points)) return;
    uint place = READ_WORD(contact_starts, i);
    Pair pair = READ(pairs, i);
    if (is_carried_forward(pair.pair_type)) {
        WRITE(contacts, place, READ(contacts_before, pair.previous));
    } else {
        uint of_a = body_of(pair.a), of_b = body_of(pair.b);
        Pose pose_b = READ(poses, of_b);
        if (PERIODIC) pose_b = at_image(pose_b, image_met(READ(properties, pair.a), of_a, READ(properties, pair.b), of_b));
        WRITE(contacts, place, contact_of(pair, FOUND_MANIFOLD(i), points, READ(poses, of_a), pose_b));
    }
    WORD(contact_pairs, place) = i;
    WORD(contact_slots, 2u * place) = NONE;
    WORD(contact_slots, 2u * place + 1u) = NONE;
    if (!REORDERED) return;
    bool is_a = READ_WORD(pair_starts, pair.a) <= i && i < READ_WORD(pair_starts, pair.a + 1u);
    WORD(contact_owners, place) = id_of(is_a ? pair.a : pair.b);
}
