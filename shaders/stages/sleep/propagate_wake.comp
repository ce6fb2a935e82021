// Sleep: propagates the depth of shaking by one contact, from bodies that shake exactly push.pass deep; later rounds do
// not change these.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/stage.glsl"

void shake(uint by, uint other) {
    if (shakes(WORD(sleep_states, by), push.pass) && READ(properties, other).motion == MOTION_DYNAMIC)
        atomicOr(WORD(sleep_states, other), shaking_bit(push.pass - 1u));
}

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts) return;
    uint of_a = body_of(READ(contacts, i).a), of_b = body_of(READ(contacts, i).b);
    shake(of_a, of_b);
    shake(of_b, of_a);
}
