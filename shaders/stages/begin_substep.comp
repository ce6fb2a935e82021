// Begins a substep for each body: warm start, gravity, forces. push.pass: 1 in the first substep,
// and twice the number of substeps that follow.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pass_bodies.glsl"

void main() {
    drive_body(thread(), push.pass >> 1);
    begin_body(thread(), (push.pass & 1u) != 0u);
}
