// Gives every touching pair its contact, which moves nobody yet.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/ids.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs || READ_WORD(point_counts, i) == 0u) return;
    uint contact = READ_WORD(contact_starts, i);
    constraints.at[contact].pair = i;
    constraints.at[contact].slot_a = NONE;
    constraints.at[contact].slot_b = NONE;
    if (!REORDERED) return;
    // Until it is prepared, who owns it: sort_slots asks.
    Pair pair = READ(pairs, i);
    bool is_a = READ_WORD(pair_starts, pair.a) <= i && i < READ_WORD(pair_starts, pair.a + 1u);
    constraints.at[contact].a = id_of(is_a ? pair.a : pair.b);
}
