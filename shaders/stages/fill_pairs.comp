// Lists the bodies whose pairs each body owns, in the order in which it finds them.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/partner_cache.glsl"

uint owner;
uint next;
void found(uint other) {
    candidates.at[next++] = Candidate(owner, other);
}
#include "shaders/stages/lib/neighbours.glsl"

void main() {
    owner = thread();
    if (owner >= PARAMETERS.bodies || COUNTED.overflow != 0u) return;
    next = READ(pair_starts, owner);
    uint count = READ(pair_starts, owner + 1u) - next;
    if (count > NOTED || !has_notes(owner)) {
        look_around(owner);
        return;
    }
    for (uint k = 0u; k < count; k += 4u) {
        Pair four = READ(pairs, 3u * owner + (k >> 2));
        found(four.a);
        if (k + 1u < count) found(four.b);
        if (k + 2u < count) found(four.kind);
        if (k + 3u < count) found(four.previous);
    }
}
