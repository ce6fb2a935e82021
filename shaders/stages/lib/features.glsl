// What cannot be in this scene: the driver leaves out what is said for it. A software device runs through both branches of every
// `if`; a GPU needs registers for both. The stages that look ahead for impacts are two shaders each instead: a software device's
// driver takes 0.3 s, every time, to read what convex shapes need before it leaves that out.
#ifndef SCREE_STAGES_FEATURES_GLSL
#define SCREE_STAGES_FEATURES_GLSL

#include "shaders/physics/base/records.h"

layout(constant_id = 1) const uint FEATURES = 0xFFFFFFFFu;
const bool BOUNCES = (FEATURES & FEATURE_BOUNCES) != 0u;
const bool PARTS = (FEATURES & FEATURE_PARTS) != 0u;
const bool ROLLS = (FEATURES & FEATURE_ROLLS) != 0u;
const bool REORDERED = (FEATURES & FEATURE_REORDERED) != 0u;
const bool JOINTS = (FEATURES & FEATURE_JOINTS) != 0u;
const bool BREAKING = (FEATURES & FEATURE_BREAKING) != 0u;

// Which of the stages that share a module this is: the lines `variants` of its file.
layout(constant_id = 3) const uint VARIANT = 0u;

// Only members that the laws compare are replaced: a zero in a sum would be folded away, and the sign of a zero with it.
Constraint narrowed(Constraint c) {
    if (!BOUNCES) c.restitution = 0.0f;
    if (!ROLLS) c.rolling_resistance = 0.0f;
    if ((FEATURES & FEATURE_ROUND) == 0u) c.anchor = c.anchor == ANCHOR_B ? ANCHOR_B : ANCHOR_A;
    if ((FEATURES & (FEATURE_ROUND | FEATURE_TYRES)) == 0u) c.radius_a = 0.0f;
    return c;
}
Impulse narrowed(Impulse impulse) {
    if (!BOUNCES) impulse.impact_velocity = vec4(0.0f);
    return impulse;
}

#endif
