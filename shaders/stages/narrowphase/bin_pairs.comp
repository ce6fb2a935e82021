// Fused: count_pair_types, scan_pair_types and fill_pair_types.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_FUSED_LISTS
#include "shaders/stages/lib/fused.glsl"
#include "shaders/stages/lib/pair_types.glsl"

#define SCANNED SCAN_KINDS
#include "shaders/stages/lib/scan.glsl"

void main() {
    uint pair_blocks = pair_blocks_of(COUNTED.pairs);
    FOR_EACH(i, pair_blocks) count_kinds_of(i);
    end_part();
    scan_whole();
    end_part();
    FOR_EACH(i, pair_blocks) list_kinds_of(i);
    FOR_EACH(i, PAIR_TYPES) tell_kind(i);
}
