// Impulses of contacts, which have their impacts in tables of their own if some body has restitution (FEATURE_BOUNCES).
#ifndef SCREE_STAGES_IMPULSES_GLSL
#define SCREE_STAGES_IMPULSES_GLSL

#include "shaders/physics/solve/contact_impulse.h"
#include "shaders/stages/lib/features.glsl"

Impulse impulse_at(uint i) {
    if (BOUNCES) return whole_impulse(READ(impulses, i), READ(impacts, i));
    return whole_impulse(READ(impulses, i), no_impact());
}
// Of last step's contact.
Impulse impulse_before(uint i) {
    if (BOUNCES) return whole_impulse(READ(impulses_before, i), READ(impacts_before, i));
    return whole_impulse(READ(impulses_before, i), no_impact());
}
// Without its impact, for stages that are not specialised by restitution.
Impulse pushes_at(uint i) {
    return whole_impulse(READ(impulses, i), no_impact());
}
Impulse pushes_before(uint i) {
    return whole_impulse(READ(impulses_before, i), no_impact());
}

void keep_impulse(uint i, Impulse impulse) {
    impulses.at[i] = contact_impulse_of(impulse);
    if (BOUNCES) impacts.at[i] = contact_impact_of(impulse);
}

#endif
