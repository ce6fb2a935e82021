// Writes the pairs that each body owns, in the order of the other body.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/stages/stage.glsl"

uint owner;
uint first;
uint next;
uint partner_of(uint pair) {
    return pairs[pair].a == owner ? pairs[pair].b : pairs[pair].a;
}
void found(uint other) {
    uint hole = next++;
    for (; hole > first && partner_of(hole - 1u) > other; --hole) pairs[hole] = pairs[hole - 1u];
    pairs[hole] = Pair(min(owner, other), max(owner, other), 0u, NONE);
}
#include "shaders/stages/neighbours.glsl"

void main() {
    owner = thread();
    if (owner >= PARAMETERS.bodies || COUNTS.overflow != 0u) return;
    first = pair_starts[owner];
    next = first;
    look_around(owner);
}
