// Begins a substep for each body: warm start, gravity, forces. push.pass: PASS_FIRST in the first substep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pass_bodies.glsl"

void main() {
    begin_body(thread(), push.pass != 0u);
}
