// Slots of contacts with their bodies: counted, filled in any order, then sorted.
#ifndef SCREE_STAGES_SLOTS_GLSL
#define SCREE_STAGES_SLOTS_GLSL

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/ids.glsl"

bool can_be_moved(uint body) {
    return is_movable(READ(properties, body).motion, READ_WORD(sleep_states, body), PARAMETERS.sleep_steps);
}

// Counts a slot for each movable body of the contact.
void count_slots_of(uint contact) {
    if (contact >= COUNTED.contacts || !any_stirs(COUNTED)) return;
    uint of_a = body_of(READ(contacts, contact).a), of_b = body_of(READ(contacts, contact).b);
    if (can_be_moved(of_a)) atomicAdd(WORD(slot_counts, of_a), 1u);
    if (can_be_moved(of_b)) atomicAdd(WORD(slot_counts, of_b), 1u);
}

// Fills the slots, and lists the contacts that have one, in any order.
void fill_slots_of(uint contact) {
    if (contact >= COUNTED.contacts || !any_stirs(COUNTED)) return;
    uint of_a = body_of(READ(contacts, contact).a), of_b = body_of(READ(contacts, contact).b);
    bool moves_a = can_be_moved(of_a);
    bool moves_b = can_be_moved(of_b);
    if (moves_a) WORD(slot_sides, atomicAdd(WORD(slot_starts, of_a), 1u)) = 2u * contact;
    if (moves_b) WORD(slot_sides, atomicAdd(WORD(slot_starts, of_b), 1u)) = 2u * contact + 1u;
    if (!moves_a && !moves_b) return;
    WORD(contacts_to_solve, atomicAdd(COUNTS.solver_contacts, 1u)) = contact;
}

// Order of a body's slots, which fixes the order of its sum: by the id of the contact's owner, then by contact; joints
// last.
uvec2 key_of_slot(uint slot) {
    uint side = WORD(slot_sides, slot), owner = 0u;
    if (REORDERED) owner = (side & OF_JOINT) != 0u ? NONE : READ_WORD(contact_owners, side >> 1);
    return uvec2(owner, side);
}
#define SORT_KEY(i) key_of_slot(i)
#define SORT_SET(i, key) WORD(slot_sides, i) = (key).y
#include "shaders/stages/lib/sort.glsl"

// Tells a side its slot.
void assign_slot(uint slot) {
    uint side = WORD(slot_sides, slot);
    if ((side & OF_JOINT) != 0u)
        block_bodies.at[side & ~OF_JOINT].slot = slot;
    else
        WORD(contact_slots, side) = slot;
}

uvec2 slots_of(uint body) {
    uint first = body == 0u ? 0u : READ_WORD(slot_ends, body - 1u);
    return uvec2(first, READ_WORD(slot_ends, body) - first);
}

// Writes where the contacts that a body owns begin, and sorts its slots, or notes them if they are many. All threads of a
// workgroup then call order_long_slots().
void order_slots_of(uint body) {
    if (COUNTED.overflow != 0u) return;
    if (body == 0u) {  // also if there are no bodies
        WORD(first_contacts, PARAMETERS.bodies) = COUNTED.contacts;
        COUNTS.arguments[WORK_SOLVER_CONTACTS] = work_for(COUNTED.solver_contacts, PARAMETERS);
    }
    if (body >= PARAMETERS.bodies) return;
    WORD(first_contacts, body) = READ_WORD(contact_starts, READ_WORD(pair_starts, body));
    uvec2 own = slots_of(body);
    if (own.y > SHORT_RANGE) {
        note_long_range(body);
        return;
    }
    sort_range(own.x, own.y);
    if (own.y == 0u) return;
    uint k = own.x;
    do assign_slot(k);
    while (++k < own.x + own.y);
}

void order_long_slots() {
    uint noted = long_ranges_noted();
    for (uint i = 0u; i < noted; ++i) {
        uvec2 own = slots_of(long_range[i]);
        sort_range_together(own.x, own.y);
#define SCREE_ASSIGN(t) \
    if ((t) < own.y) assign_slot(own.x + (t));
        FOR_FOUR(t, own.y, SCREE_ASSIGN)
#undef SCREE_ASSIGN
    }
}

#endif
