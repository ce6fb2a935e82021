// Gives every touching pair its contact, which moves nobody yet.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs || READ(touching, i) == 0u) return;
    uint contact = READ(contact_starts, i);
    constraints.at[contact].pair = i;
    constraints.at[contact].slot_a = NONE;
    constraints.at[contact].slot_b = NONE;
}
