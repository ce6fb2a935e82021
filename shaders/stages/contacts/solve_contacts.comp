// The biased pass over all solver contacts in parallel.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pass_contacts.glsl"

void main() {
    solve_contact(thread());
}
