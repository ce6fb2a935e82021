// Measures the separations of contacts that are kept.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/persistence.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread() + COUNTS.kind_first[KIND_KEPT];
    if (i >= COUNTS.kind_first[KIND_KEPT + 1u]) return;
    uint index = binned[i];
    Pair pair = pairs[index];
    Contact contact = contacts_before[pair.previous];
    manifolds[index] = kept_manifold(contact, poses[body_of(pair.a)], poses[body_of(pair.b)]);
    touching[index] = contact.count;
}
