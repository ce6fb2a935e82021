// Exclusive prefix sums in three stages (reduce, then scan): block sums, a scan of these by one workgroup, offsets.
//
// No workgroup waits for another, because Vulkan guarantees no forward progress: decoupled look-back would hang on some
// devices. The scanned list is the variant's choice, or the including stage's as SCANNED.
#ifndef SCREE_STAGES_SCAN_GLSL
#define SCREE_STAGES_SCAN_GLSL

#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/prefix_sum.glsl"
#include "shaders/stages/lib/stage.glsl"

const uint SCAN_CELLS = 0u;
const uint SCAN_PAIRS = 1u;
const uint SCAN_KINDS = 2u;
const uint SCAN_CONTACTS = 3u;
const uint SCAN_SLOTS = 4u;
#ifndef SCANNED
#define SCANNED VARIANT
#endif

uint scan_items() {
    uint items = PARAMETERS.bodies;  // SCAN_PAIRS, SCAN_SLOTS
    if (SCANNED == SCAN_CELLS)
        items = buckets_in_all(PARAMETERS);
    else if (SCANNED == SCAN_KINDS)
        items = PAIR_TYPES * pair_blocks_of(COUNTED.pairs);
    else if (SCANNED == SCAN_CONTACTS)
        items = COUNTED.pairs;
    return items;
}
uint scan_read(uint i) {
    uint value = 0u;
    if (SCANNED == SCAN_CELLS)
        value = READ_WORD(cell_counts, i);
    else if (SCANNED == SCAN_PAIRS)
        value = READ_WORD(pair_counts, i);
    else if (SCANNED == SCAN_KINDS)
        value = READ_WORD(pair_type_counts, i);
    else if (SCANNED == SCAN_CONTACTS)
        value = has_points(READ_WORD(point_counts, i)) ? 1u : 0u;
    else
        value = READ_WORD(slot_counts, i);
    return value;
}
void scan_write(uint i, uint sum) {
    if (SCANNED == SCAN_CELLS)
        WORD(cell_starts, i) = sum;
    else if (SCANNED == SCAN_PAIRS)
        WORD(pair_starts, i) = sum;
    else if (SCANNED == SCAN_SLOTS)
        WORD(slot_starts, i) = sum;
    else if (SCANNED == SCAN_KINDS)
        WORD(pair_type_starts, i) = sum;
    else
        WORD(contact_starts, i) = sum;
}
// The counts and dispatches that follow from the total.
void scan_total(uint total) {
    if (SCANNED == SCAN_PAIRS)
        COUNTS = with_pairs(COUNTS, total, PARAMETERS);
    else if (SCANNED == SCAN_CONTACTS)
        COUNTS = with_contacts(COUNTS, total, PARAMETERS);
}

// Writes the exclusive sums of a thread's items from `first` on; the sum before its workgroup's is `before`.
void scan_group(uint first, uint items, uint before) {
    uint values[SCAN_ITEMS];
    uint sum = 0u;
    for (uint k = 0u; k < SCAN_ITEMS; ++k) {
        values[k] = first + k < items ? scan_read(first + k) : 0u;
        sum += values[k];
    }
    uint running = before + sum_before(sum);
    for (uint k = 0u; k < SCAN_ITEMS; ++k) {
        if (first + k <= items) scan_write(first + k, running);
        running += values[k];
    }
}

#ifdef SCREE_FUSED
// A short list, by one workgroup.
void scan_whole() {
    uint items = scan_items();
    uint total = 0u;
    for (uint begin = 0u; begin <= items; begin += gl_WorkGroupSize.x << SCAN_SHIFT) {
        scan_group(begin + (gl_LocalInvocationID.x << SCAN_SHIFT), items, total);
        end_part();
        total += partial[gl_WorkGroupSize.x - 1u];
        end_part();
    }
    if (gl_LocalInvocationID.x == 0u) scan_total(total);
}
#endif

#endif
