// variants: scan_cells_sums VARIANT=0
// variants: scan_pairs_sums VARIANT=1
// variants: scan_pair_types_sums VARIANT=2
// variants: scan_contacts_sums VARIANT=3
// variants: scan_slots_sums VARIANT=4
// Prefix sum, first stage: the sum of each block.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/scan.glsl"

void main() {
    uint items = scan_items();
    uint first = thread() << SCAN_SHIFT;
    uint sum = 0u;
    for (uint i = first; i < min(first + SCAN_ITEMS, items); ++i) sum += scan_read(i);
    uint before = sum_before(sum);
    if (gl_LocalInvocationID.x == gl_WorkGroupSize.x - 1u && group() < scan_blocks_of(items, PARAMETERS))
        WORD(scan_sums, group()) = before + sum;
}
