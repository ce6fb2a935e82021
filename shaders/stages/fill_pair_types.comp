// Lists the pairs kind by kind, in their order, and says how many of each there are.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pair_types.glsl"

void main() {
    list_kinds_of(thread());
    tell_kind(thread());
}
