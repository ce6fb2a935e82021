// variants: fill_pairs -DWITHOUT_IMAGES
// variants: fill_pairs_periodic -DWITH_IMAGES
// Broadphase: lists the partners of each body's pairs, in the order of the search.
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
    next = READ_WORD(pair_starts, owner);
    uint count = READ_WORD(pair_starts, owner + 1u) - next;
    if (count > CACHED_PARTNERS || !has_cache(owner)) {
        look_around(owner);
        return;
    }
    for (uint k = 0u; k < count; k += 4u) {
        uvec4 four = CACHED(3u * owner + (k >> 2));
        found(four.x);
        if (k + 1u < count) found(four.y);
        if (k + 2u < count) found(four.z);
        if (k + 3u < count) found(four.w);
    }
}
