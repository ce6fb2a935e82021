// Carries over the manifolds of pairs that do not stir.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/persistence.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread() + COUNTS.kind_first[KIND_STILL];
    if (i >= COUNTS.kind_first[KIND_STILL + 1u]) return;
    uint index = binned.at[i];
    uint previous = pairs.at[index].previous;
    Contact contact = contacts_before.at[previous];
    manifolds.at[index] = resting_manifold(contact, impulses_before.at[previous]);
    touching.at[index] = contact.count;
}
