// Counts the contacts of each movable body.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/slots.glsl"

void main() {
    count_slots_of(thread());
}
