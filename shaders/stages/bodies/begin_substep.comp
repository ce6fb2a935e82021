// Begins a substep for each body: warm start, gravity, forces. push.pass: PASS_FIRST, and from bit PASS_FOLLOWING on the number
// of substeps that follow.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pass_bodies.glsl"

void main() {
    drive_body(thread(), push.pass >> PASS_FOLLOWING);
    begin_body(thread());
}
