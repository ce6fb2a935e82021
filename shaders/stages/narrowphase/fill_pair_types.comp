// Lists the pairs by type, stably, and writes the dispatches of the narrowphase.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pair_types.glsl"

void main() {
    list_kinds_of(thread());
    tell_kind(thread());
}
