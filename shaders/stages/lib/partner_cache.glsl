// The first partners that each body finds while they are counted, noted so that they need not be sought again to be listed. They
// stand in the table of pairs, which nobody reads before it is made anew, twelve in three records for each body.
#ifndef SCREE_STAGES_NOTES_GLSL
#define SCREE_STAGES_NOTES_GLSL

#include "shaders/stages/lib/stage.glsl"

const uint NOTED = 12u;
bool has_notes(uint body) {
    return 3u * body + 3u <= PARAMETERS.pair_capacity;
}

struct Notes {
    uvec4 first, second, third;
};
uvec4 noted(uvec4 four, uint place, uint partner) {
    return uvec4(place == 0u ? partner : four.x, place == 1u ? partner : four.y, place == 2u ? partner : four.z,
                 place == 3u ? partner : four.w);
}
// As the k-th. Into registers all the same: a software device stores word by word, for every place where it might.
void note(inout Notes notes, uint k, uint partner) {
    notes.first = noted(notes.first, k, partner);
    notes.second = noted(notes.second, k - 4u, partner);
    notes.third = noted(notes.third, k - 8u, partner);
}
Pair packed(uvec4 four) {
    return Pair(four.x, four.y, four.z, four.w);
}
void keep(Notes notes, uint body) {
    if (!has_notes(body)) return;
    pairs.at[3u * body] = packed(notes.first);
    pairs.at[3u * body + 1u] = packed(notes.second);
    pairs.at[3u * body + 2u] = packed(notes.third);
}

#endif
