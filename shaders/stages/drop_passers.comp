// Drops the doubtful contacts of bodies that nothing strikes in this step: those will keep the course that was foreseen.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/impact.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.pairs || (touching[i] & DOUBTFUL) == 0u) return;
    bool struck = (bounds[body_of(pairs[i].a)].flight.struck | bounds[body_of(pairs[i].b)].flight.struck) != 0u;
    touching[i] = struck ? touching[i] & ~DOUBTFUL : 0u;
}
