// variants: scan_cells_spine -DSCAN_CELLS
// variants: scan_pairs_spine -DSCAN_PAIRS
// variants: scan_kinds_spine -DSCAN_KINDS
// variants: scan_contacts_spine -DSCAN_CONTACTS
// variants: scan_slots_spine -DSCAN_SLOTS
// Scans the sums of the blocks, by one workgroup, and says what the total means for the rest of the step.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/scan.glsl"

void main() {
    uint blocks = scan_work_for(SCAN_ITEMS_OF, PARAMETERS).x;
    uint total = 0u;
    for (uint first = 0u; first < blocks; first += gl_WorkGroupSize.x) {
        uint i = first + gl_LocalInvocationID.x;
        uint value = i < blocks ? WORD(scan_sums, i) : 0u;
        uint before = sum_before(value);
        if (i < blocks) WORD(scan_sums, i) = total + before;
        barrier();
        total += partial[gl_WorkGroupSize.x - 1u];
        barrier();
    }
    barrier();  // the total may change what the others count to
    if (gl_LocalInvocationID.x == 0u) {
        SCAN_TOTAL(total);
    }
}
