// Impulses of contacts, which have their impacts in tables of their own if some body has restitution (FEATURE_BOUNCES).
#ifndef SCREE_STAGES_IMPULSES_GLSL
#define SCREE_STAGES_IMPULSES_GLSL

#include "shaders/physics/base/contact_impulse.h"
#include "shaders/stages/lib/features.glsl"

Impulse impulse_at(uint i) {
    if (BOUNCES) return whole_impulse(READ_GROUPED(impulses, i), READ_GROUPED(impacts, i));
    return whole_impulse(READ_GROUPED(impulses, i), no_impact());
}
// Of last step's contact.
Impulse impulse_before(uint i) {
    if (BOUNCES) return whole_impulse(READ_GROUPED(impulses_before, i), READ_GROUPED(impacts_before, i));
    return whole_impulse(READ_GROUPED(impulses_before, i), no_impact());
}
// Without its impact, for stages that are not specialised by restitution.
Impulse pushes_at(uint i) {
    return whole_impulse(READ_GROUPED(impulses, i), no_impact());
}
Impulse pushes_before(uint i) {
    return whole_impulse(READ_GROUPED(impulses_before, i), no_impact());
}

void keep_impulse(uint i, Impulse impulse) {
    write_impulses(i, contact_impulse_of(impulse), EVERY_MEMBER);
    if (BOUNCES) write_impacts(i, contact_impact_of(impulse), EVERY_MEMBER);
}

#endif
