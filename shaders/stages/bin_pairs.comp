// count_kinds, scan_kinds and fill_kinds in one.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_FUSED_LISTS
#include "shaders/stages/lib/fused.glsl"
#include "shaders/stages/lib/pair_types.glsl"

#define SCANNED SCAN_KINDS
#include "shaders/stages/lib/scan.glsl"

void main() {
    uint spans = spans_of(COUNTED.pairs);
    FOR_EACH(i, spans) count_kinds_of(i);
    end_part();
    scan_whole();
    end_part();
    FOR_EACH(i, spans) list_kinds_of(i);
    FOR_EACH(i, KINDS) tell_kind(i);
}
