// Counts pair types in each block of 16 pairs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pair_types.glsl"

void main() {
    count_kinds_of(thread());
}
