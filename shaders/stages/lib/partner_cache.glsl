// Broadphase cache: the first twelve partners of each body, three quads, from count_pairs for fill_pairs, which then
// need not search again. In the memory of the table of pairs, which is dead until match_pairs writes it.
#ifndef SCREE_STAGES_PARTNER_CACHE_GLSL
#define SCREE_STAGES_PARTNER_CACHE_GLSL

#include "shaders/stages/lib/stage.glsl"

// That memory as quads: partner_cache.at[i] to write, CACHED(i) to read.
#ifdef SCREE_BDA
layout(std430, buffer_reference, buffer_reference_align = 16) buffer PartnerCacheTable {
    uvec4 at[];
};
#define partner_cache PartnerCacheTable(pairs)
#else
#define SCREE_BINDING(index, name, block, record, length) const int name##_binding = index;
SCREE_BUFFERS(SCREE_BINDING)
layout(std430, set = 0, binding = pairs_binding) buffer PartnerCacheTable {
    uvec4 at[];
}
partner_cache;
#endif
#ifdef SCREE_TEXELS
#define CACHED(i) texelFetch(pairs_texels, int(i))
#else
#define CACHED(i) partner_cache.at[i]
#endif

const uint CACHED_PARTNERS = 12u;
bool has_cache(uint body) {
    return 3u * body + 3u <= PARAMETERS.pair_capacity;
}

struct Partners {
    uvec4 first, second, third;
};
uvec4 with_partner(uvec4 four, uint place, uint partner) {
    return uvec4(place == 0u ? partner : four.x, place == 1u ? partner : four.y, place == 2u ? partner : four.z,
                 place == 3u ? partner : four.w);
}
// Sets partner k, in registers by selects: a software device would store word by word for every possible index.
void note(inout Partners partners, uint k, uint partner) {
    partners.first = with_partner(partners.first, k, partner);
    partners.second = with_partner(partners.second, k - 4u, partner);
    partners.third = with_partner(partners.third, k - 8u, partner);
}
void keep(Partners partners, uint body) {
    if (!has_cache(body)) return;
    partner_cache.at[3u * body] = partners.first;
    partner_cache.at[3u * body + 1u] = partners.second;
    partner_cache.at[3u * body + 2u] = partners.third;
}

#endif
