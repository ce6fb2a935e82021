// Gives every touching pair its contact.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.pairs || touching[i] == 0u) return;
    constraints[contact_starts[i]].pair = i;
}
