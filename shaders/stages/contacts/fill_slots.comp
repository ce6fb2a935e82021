// Assigns each contact a slot with each of its movable bodies, and lists the contacts that the solver processes, in any
// order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/slots.glsl"

void main() {
    fill_slots_of(thread());
}
