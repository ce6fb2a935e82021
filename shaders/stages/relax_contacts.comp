// variants: relax_contacts
// variants: relax_contacts_felt -DWITH_FRACTURES
// The pass without bias over all contacts that move somebody at once.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/lib/pass_contacts.glsl"

void main() {
    relax_contact(thread(), push.pass);
}
