// Applies the biased pass to each body and integrates its pose by a substep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pass_bodies.glsl"

void main() {
    move_body(thread());
}
