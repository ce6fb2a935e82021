// Slots of contacts with their bodies: counted, filled in any order, then sorted.
#ifndef SCREE_STAGES_SLOTS_GLSL
#define SCREE_STAGES_SLOTS_GLSL

#include "shaders/physics/extra/sleep.h"
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
    uint place = atomicAdd(COUNTS.solver_contacts, 1u);
    WORD(contacts_to_solve, place) = contact;
    uint group = place >> PARAMETERS.group_shift;
    if ((place & (PARAMETERS.group_size - 1u)) == 0u) atomicMax(COUNTS.arguments[WORK_SOLVER_CONTACTS].x, group + 1u);
}

// Order of a body's slots, which fixes the order of its sum: by the id of the contact's owner, then by contact; joints
// last.
bool comes_before(uint side, uint other) {
    if (!REORDERED) return side < other;
    uint owner = NONE, other_owner = NONE;
    if ((side & OF_JOINT) == 0u) owner = READ_WORD(contact_owners, side >> 1);
    if ((other & OF_JOINT) == 0u) other_owner = READ_WORD(contact_owners, other >> 1);
    return owner < other_owner || (owner == other_owner && side < other);
}
#define SORT_GET(i) WORD(slot_sides, i)
#define SORT_SET(i, value) WORD(slot_sides, i) = value
#define SORT_BEFORE(x, y) comes_before(x, y)
#include "shaders/stages/lib/sort.glsl"

// Tells a side its slot.
void assign_slot(uint slot) {
    uint side = WORD(slot_sides, slot);
    if ((side & OF_JOINT) != 0u)
        block_bodies.at[side & ~OF_JOINT].slot = slot;
    else
        WORD(contact_slots, side) = slot;
}

// Sorts a body's slots and writes where the contacts it owns begin.
void order_slots_of(uint body) {
    if (COUNTED.overflow != 0u) return;
    if (body == 0u) WORD(first_contacts, PARAMETERS.bodies) = COUNTED.contacts;  // also if there are no bodies
    if (body >= PARAMETERS.bodies) return;
    WORD(first_contacts, body) = READ_WORD(contact_starts, READ_WORD(pair_starts, body));
    uint first = body == 0u ? 0u : READ_WORD(slot_ends, body - 1u);
    uint count = READ_WORD(slot_ends, body) - first;
    sort_range(first, count);
    // Four a round, for long lists on lavapipe (sort.glsl).
    for (uint k = first; k < first + count; k += 4u) {
        assign_slot(k);
        if (k + 1u < first + count) assign_slot(k + 1u);
        if (k + 2u < first + count) assign_slot(k + 2u);
        if (k + 3u < first + count) assign_slot(k + 3u);
    }
}

#endif
