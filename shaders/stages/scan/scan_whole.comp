// variants: scan_cells VARIANT=0
// variants: scan_pairs VARIANT=1
// variants: scan_contacts VARIANT=3
// variants: scan_slots VARIANT=4
// Fused: the prefix sum of a short list.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_FUSED_LISTS
#include "shaders/stages/lib/fused.glsl"
#include "shaders/stages/lib/scan.glsl"

void main() {
    scan_whole();
}
