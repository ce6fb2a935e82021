// variants: scan_cells_offsets -DSCAN_CELLS
// variants: scan_pairs_offsets -DSCAN_PAIRS
// variants: scan_kinds_offsets -DSCAN_KINDS
// variants: scan_contacts_offsets -DSCAN_CONTACTS
// variants: scan_slots_offsets -DSCAN_SLOTS
// Writes the sum of all items before each, and behind the last item the total.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/scan.glsl"

void main() {
    uint items = SCAN_ITEMS_OF;
    uint first = thread() << SCAN_SHIFT;
    uint values[SCAN_ITEMS];
    uint sum = 0u;
    for (uint k = 0u; k < SCAN_ITEMS; ++k) {
        values[k] = first + k < items ? SCAN_READ(first + k) : 0u;
        sum += values[k];
    }
    uint running = READ_WORD(scan_sums, gl_WorkGroupID.x) + sum_before(sum);
    for (uint k = 0u; k < SCAN_ITEMS; ++k) {
        if (first + k <= items) SCAN_WRITE(first + k, running);
        running += values[k];
    }
}
