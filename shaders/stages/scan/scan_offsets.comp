// variants: scan_cells_offsets VARIANT=0
// variants: scan_pairs_offsets VARIANT=1
// variants: scan_pair_types_offsets VARIANT=2
// variants: scan_contacts_offsets VARIANT=3
// variants: scan_slots_offsets VARIANT=4
// Prefix sum, third stage: exclusive offsets, and the total behind the last item.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/scan.glsl"

void main() {
    uint items = scan_items();
    uint before = READ_WORD(scan_sums, min(group(), scan_blocks_of(items, PARAMETERS) - 1u));
    scan_group(thread() << SCAN_SHIFT, items, before);
}
