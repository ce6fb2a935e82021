// Blocks of contacts (shaders/physics/contact/contact_block.h): which contacts follow one another.
#ifndef SCREE_STAGES_CONTACT_BLOCKS_GLSL
#define SCREE_STAGES_CONTACT_BLOCKS_GLSL

#include "shaders/physics/contact/contact_block.h"
#include "shaders/stages/lib/ids.glsl"

// The slots of the movable body of a contact that has fewer: all contacts of the pair are among them, in one order.
struct SlotsOfBody {
    uint first, own, last;
};
SlotsOfBody slots_of_body(uint body, uint own) {
    SlotsOfBody found;
    found.first = body == 0u ? 0u : READ_WORD(slot_ends, body - 1u);
    found.own = own;
    found.last = READ_WORD(slot_ends, body);
    return found;
}
SlotsOfBody slots_of_pair(uint of_a, uint slot_a, uint of_b, uint slot_b) {
    SlotsOfBody of_one = slots_of_body(slot_a != NONE ? of_a : of_b, slot_a != NONE ? slot_a : slot_b);
    if (slot_a == NONE || slot_b == NONE) return of_one;
    SlotsOfBody of_other = slots_of_body(of_b, slot_b);
    if (of_other.last - of_other.first < of_one.last - of_one.first) of_one = of_other;
    return of_one;
}

// The contact in a slot if it is one of the same two bodies and shares their block; else NONE.
uint partner_in(uint slot, uint of_a, uint of_b) {
    uint side = READ_WORD(slot_sides, slot);
    if ((side & OF_JOINT) != 0u) return NONE;
    Contact other = READ(contacts, side >> 1);
    BodyProperties ta = READ(properties, other.a), tb = READ(properties, other.b);
    bool partners = (is_part(ta) ? ta.owner : other.a) == of_a && (is_part(tb) ? tb.owner : other.b) == of_b;
    return partners && shares_block(ta, tb, PARAMETERS) ? side >> 1 : NONE;
}
bool follows_another(SlotsOfBody slots, uint of_a, uint of_b) {
    uint before = 0u;
    for (uint slot = slots.first; slot < slots.own; ++slot) {
        if (partner_in(slot, of_a, of_b) != NONE) ++before;
    }
    return before % BLOCK_CONTACTS != 0u;
}
uint next_partner(SlotsOfBody slots, uint of_a, uint of_b) {
    uint partner = NONE;
    for (uint slot = slots.own + 1u; slot < slots.last && partner == NONE; ++slot) partner = partner_in(slot, of_a, of_b);
    return partner;
}

#endif
