// variants: fill_pairs -DWITHOUT_JOINTS
// variants: fill_pairs_joined -DWITH_JOINTS
// Lists the bodies whose pairs each body owns, in the order in which it finds them.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

uint owner;
uint next;
void found(uint other) {
    candidates.at[next++] = Candidate(owner, other);
}
#include "shaders/stages/neighbours.glsl"

void main() {
    owner = thread();
    if (owner >= PARAMETERS.bodies || COUNTED.overflow != 0u) return;
    next = READ(pair_starts, owner);
    look_around(owner);
}
