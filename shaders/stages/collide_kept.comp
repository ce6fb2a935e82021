// Measures the separations of contacts that are kept.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/persistence.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread() + COUNTS.kind_first[KIND_KEPT];
    if (i >= COUNTS.kind_first[KIND_KEPT + 1u]) return;
    uint index = binned.at[i];
    Pair pair = pairs.at[index];
    Contact contact = contacts_before.at[pair.previous];
    manifolds.at[index] = kept_manifold(contact, poses.at[pair.a], poses.at[pair.b]);
    touching.at[index] = contact.count;
}
