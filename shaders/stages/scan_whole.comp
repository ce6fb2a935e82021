// variants: scan_cells -DSCAN_CELLS
// variants: scan_pairs -DSCAN_PAIRS
// variants: scan_contacts -DSCAN_CONTACTS
// variants: scan_slots -DSCAN_SLOTS
// A short list's scan in one.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_FUSED_LISTS
#include "shaders/stages/lib/fused.glsl"
#include "shaders/stages/lib/scan.glsl"

void main() {
    scan_whole();
}
