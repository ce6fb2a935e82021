// variants: count_pairs -DWITHOUT_IMAGES
// variants: count_pairs_periodic -DWITH_IMAGES
// Broadphase: counts the pairs that each body owns.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/partner_cache.glsl"

uint pairs_found = 0u;
Partners partners = Partners(uvec4(0u), uvec4(0u), uvec4(0u));
void found(uint other) {
    note(partners, pairs_found, other);
    ++pairs_found;
}
#include "shaders/stages/lib/neighbours.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTED.overflow != 0u) return;
    look_around(i);
    keep(partners, i);
    WORD(pair_counts, i) = pairs_found;
    if (pairs_found > 0u) atomicAdd(COUNTS.pairs_coarse, (pairs_found + 255u) >> 8);
}
