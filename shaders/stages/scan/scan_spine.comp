// variants: scan_cells_spine VARIANT=0
// variants: scan_pairs_spine VARIANT=1
// variants: scan_pair_types_spine VARIANT=2
// variants: scan_contacts_spine VARIANT=3
// variants: scan_slots_spine VARIANT=4
// Prefix sum, second stage: one workgroup scans the block sums; the total sets the dispatches that depend on it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/scan.glsl"

void main() {
    uint blocks = scan_blocks_of(scan_items(), PARAMETERS);
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
    barrier();  // scan_total() changes the counts that other threads read
    if (gl_LocalInvocationID.x == 0u) scan_total(total);
}
