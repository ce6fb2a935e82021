// variants: scan_cells_sums -DSCAN_CELLS
// variants: scan_pairs_sums -DSCAN_PAIRS
// variants: scan_kinds_sums -DSCAN_KINDS
// variants: scan_contacts_sums -DSCAN_CONTACTS
// variants: scan_slots_sums -DSCAN_SLOTS
// Adds up each block of a list that is scanned.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/scan.glsl"

void main() {
    uint items = SCAN_ITEMS_OF;
    uint first = thread() << SCAN_SHIFT;
    uint sum = 0u;
    for (uint i = first; i < min(first + SCAN_ITEMS, items); ++i) sum += SCAN_READ(i);
    uint before = sum_before(sum);
    if (gl_LocalInvocationID.x == gl_WorkGroupSize.x - 1u) WORD(scan_sums, gl_WorkGroupID.x) = before + sum;
}
