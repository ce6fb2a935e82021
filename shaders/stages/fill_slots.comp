// Gives each contact a slot with each of its bodies that can be moved, and lists those that have one, in any order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/slots.glsl"

void main() {
    fill_slots_of(thread());
}
