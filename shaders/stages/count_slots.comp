// Counts the contacts of each body that can be moved.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/slots.glsl"

void main() {
    count_slots_of(thread());
}
