// Sorts each body's slots by contact, so that its sum has one order; and says where the contacts it owns begin.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void sink(uint first, uint root, uint count) {
    uint value = slot_sides[first + root];
    for (uint child = 2u * root + 1u; child < count; child = 2u * root + 1u) {
        if (child + 1u < count && slot_sides[first + child + 1u] > slot_sides[first + child]) ++child;
        if (slot_sides[first + child] <= value) break;
        slot_sides[first + root] = slot_sides[first + child];
        root = child;
    }
    slot_sides[first + root] = value;
}

// Few contacts: insertion. A body that carries thousands: heap sort, which no arrangement slows down.
void sort_sides(uint first, uint count) {
    if (count <= 32u) {
        for (uint k = first + 1u; k < first + count; ++k) {
            uint side = slot_sides[k];
            uint hole = k;
            for (; hole > first && slot_sides[hole - 1u] > side; --hole) slot_sides[hole] = slot_sides[hole - 1u];
            slot_sides[hole] = side;
        }
        return;
    }
    for (uint root = count >> 1; root > 0u; --root) sink(first, root - 1u, count);
    for (uint end = count - 1u; end > 0u; --end) {
        uint largest = slot_sides[first];
        slot_sides[first] = slot_sides[first + end];
        slot_sides[first + end] = largest;
        sink(first, 0u, end);
    }
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.bodies || COUNTS.overflow != 0u) return;
    first_contacts[i] = contact_starts[pair_starts[i]];
    if (i == PARAMETERS.bodies - 1u) first_contacts[i + 1u] = COUNTS.contacts;
    uint first = i == 0u ? 0u : slot_ends[i - 1u];
    uint count = slot_ends[i] - first;
    sort_sides(first, count);
    for (uint k = first; k < first + count; ++k) {
        uint side = slot_sides[k];
        if ((side & 1u) == 0u)
            constraints[side >> 1].slot_a = k;
        else
            constraints[side >> 1].slot_b = k;
    }
}
