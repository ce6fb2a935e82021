// Sorts each body's pairs by the other body's id, matches them with last step's contacts, and chooses their pair types.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/body/motion.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/contact/persistence.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/images.glsl"
#include "shaders/stages/lib/impulses.glsl"

// Binary search: contacts of an owner are sorted by the other body's id.
uint contact_before(uint owner, uint other) {
    uint id = id_of(other);
    uint low = READ_WORD(first_contacts, owner);
    uint high = READ_WORD(first_contacts, owner + 1u);
    if (low >= high) return NONE;
    do {
        uint middle = (low + high) >> 1;
        uint a = READ(contacts_before, middle).a;
        uint partner = a == owner ? READ(contacts_before, middle).b : a;
        if (partner == other) return middle;
        if (id_of(partner) < id)
            low = middle + 1u;
        else
            high = middle;
    } while (low < high);
    return NONE;
}

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs) return;
    Candidate candidate = READ(candidates, i);
    uint place = READ_WORD(pair_starts, candidate.owner);
    uint last = READ_WORD(pair_starts, candidate.owner + 1u);
    uint own = id_of(candidate.owner), id = id_of(candidate.other);
    uint k = place;
    do {
        if (id_of(READ(candidates, k).other) < id) ++place;
    } while (++k < last);
    Pair pair = Pair(own < id ? candidate.owner : candidate.other, own < id ? candidate.other : candidate.owner, 0u, NONE);
    // The owner differs from last step's if a body's grid level changed.
    if (!is_newborn(body_of(pair.a))) {
        pair.previous = contact_before(pair.a, pair.b);
        if (pair.previous == NONE) pair.previous = contact_before(pair.b, pair.a);
    }
    if ((READ(bounds, pair.a).level & READ(bounds, pair.b).level & INACTIVE) != 0u) {
        pair.pair_type = PAIR_INACTIVE;
    } else {
        BodyProperties ta = READ(properties, pair.a), tb = READ(properties, pair.b);
        uint of_a = body_of(pair.a), of_b = body_of(pair.b);
        bool kept = false;
        if (pair.previous != NONE && has_weight(parameters_of(of_a)) &&
            may_persist(pushes_before(pair.previous), ta.shape, tb.shape)) {
            Pose pose_b = READ(poses, of_b);
            Velocity velocity_b = READ(velocities, of_b);
            if (PERIODIC) {
                Image image = image_met(ta, of_a, tb, of_b);
                pose_b = at_image(pose_b, image);
                velocity_b = at_image(velocity_b, image);
            }
            kept = is_persistent(READ(contacts_before, pair.previous), ta, READ(poses, of_a), READ(velocities, of_a), tb, pose_b,
                                 velocity_b);
        }
        pair.pair_type = kept ? PAIR_PERSISTENT : pair_type_of(ta.shape, tb.shape);
    }
    WRITE(pairs, place, pair);
}
