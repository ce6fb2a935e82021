// Sorts each body's slots, which fixes the order of its sum, and writes where the contacts it owns begin.
#version 460
#extension GL_GOOGLE_include_directive : require

#define SCREE_SORTS_TOGETHER
#include "shaders/stages/lib/slots.glsl"

void main() {
    begin_long_ranges();
    order_slots_of(thread());
    order_long_slots();
}
