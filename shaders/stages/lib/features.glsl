// Specialisation by the features of a scene: the driver removes code that the scene does not need. A software device
// runs both branches of every `if`; a GPU reserves registers for both. Stages that look ahead for impacts are two
// shaders each instead: lavapipe takes 0.3 s, every time, to parse the code for convex shapes before it removes that.
#ifndef SCREE_STAGES_FEATURES_GLSL
#define SCREE_STAGES_FEATURES_GLSL

#include "shaders/physics/base/records.h"

layout(constant_id = 1) const uint FEATURES = 0xFFFFFFFFu;
const bool BOUNCES = (FEATURES & FEATURE_BOUNCES) != 0u;
const bool PARTS = (FEATURES & FEATURE_PARTS) != 0u;
const bool ROLLS = (FEATURES & FEATURE_ROLLS) != 0u;
const bool REORDERED = (FEATURES & FEATURE_REORDERED) != 0u;
const bool JOINTS = (FEATURES & FEATURE_JOINTS) != 0u;
const bool SUMS = (FEATURES & FEATURE_SUMS) != 0u;
const bool SURFACES = (FEATURES & FEATURE_SURFACES) != 0u;
const bool FILTERS = (FEATURES & FEATURE_FILTERS) != 0u;
const bool COPIES = (FEATURES & FEATURE_COPIES) != 0u;
const bool GRAVITIES = (FEATURES & FEATURE_GRAVITIES) != 0u;
const bool BLOCKS = (FEATURES & FEATURE_BLOCKS) != 0u;
const bool GHOSTS = (FEATURES & FEATURE_GHOSTS) != 0u;
const bool PERIODIC = (FEATURES & FEATURE_PERIODIC) != 0u;

// Whether another rank moves the body of a row.
bool is_foreign(BodyProperties row) {
    return GHOSTS && (row.flags & ROW_FOREIGN) != 0u;
}

// The variant of a shared module: the lines `variants` of its file.
layout(constant_id = 3) const uint VARIANT = 0u;

// Replaces only members that are compared: a literal zero in a sum would be folded away, and with it the sign of a
// zero.
Constraint narrowed(Constraint c) {
    if (!BOUNCES) c.restitution = 0.0f;
    if (!BLOCKS) {
        c.links = 0u;
        c.flags = c.flags & ~(CONSTRAINT_FOLLOWS | CONSTRAINT_LEADS);
    }
    if (!ROLLS) c.rolling_resistance = 0.0f;
    if ((FEATURES & FEATURE_ROUND) == 0u) c.flags = c.flags & ~CONSTRAINT_ROUND;
    if ((FEATURES & FEATURE_TYRES) == 0u) c.tyre_slip = 0.0f;
    if (!SURFACES) {
        c.drive1 = c.drive2 = c.static_friction = c.restitution_threshold = 0.0f;
        c.flags = c.flags & ~CONSTRAINT_ROLLS_ONLY;
    }
    return c;
}

#endif
