// The pass without bias over all contacts that move somebody at once.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pass_contacts.glsl"

void main() {
    relax_contact(thread(), push.pass);
}
