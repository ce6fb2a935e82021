// Fused: count_slots, scan_slots, fill_slots and sort_slots.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_FUSED_LISTS
#include "shaders/stages/lib/fused.glsl"
#include "shaders/stages/lib/slots.glsl"

#define SCANNED SCAN_SLOTS
#include "shaders/stages/lib/scan.glsl"

void main() {
    uint bodies = PARAMETERS.bodies, contacts = COUNTED.contacts;
    FOR_EACH(i, contacts) count_slots_of(i);
    end_part();
    scan_whole();
    end_part();
    FOR_EACH(i, contacts) fill_slots_of(i);
    begin_long_ranges();
    FOR_EACH(i, max(bodies, 1u)) order_slots_of(i);
    order_long_slots();
}
