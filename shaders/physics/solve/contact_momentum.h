// Heavy-ball momentum on the normal impulses of contacts (Polyak 1964), from substep to substep.
#ifndef SCREE_PHYSICS_CONTACT_MOMENTUM_H
#define SCREE_PHYSICS_CONTACT_MOMENTUM_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

CONSTANT float MOMENTUM = 0.5f;
CONSTANT float MOMENTUM_SPLIT = 4.0f;
CONSTANT float LEAK_CUT = 0.8f;

LAW float contact_momentum(Mass a, Mass b) {
    return MOMENTUM * smaller(1.0f, MOMENTUM_SPLIT * reciprocal(larger(a.split, b.split)));
}

// The impulse with which the next substep begins.
LAW Impulse with_momentum(Impulse impulse, uint count, float momentum) {
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < count;
        if (none(there)) break;
        float now = impulse.normal[k], before = impulse.solved_normal[k];
        bool lasts = there && impulse.impact_velocity[k] == 0.0f && now > 0.0f && before > 0.0f;
        impulse.solved_normal[k] = choose(there, now, before);
        impulse.normal[k] = choose(lasts, positive(now + momentum * (now - before)), now);
    }
    return impulse;
}

LAWS_END

#endif
