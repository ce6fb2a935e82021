// Compacts pairs with contact points into contacts, which have no slots yet.
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
    Pair pair = READ(pairs, i);
    bool is_a = READ_WORD(pair_starts, pair.a) <= i && i < READ_WORD(pair_starts, pair.a + 1u);
    WORD(contact_owners, contact) = id_of(is_a ? pair.a : pair.b);
}
