// How a body's mass is shared out among the contacts that it has to bear.
//
// Mass splitting converges for any parts of a body's mass that sum to 1 (block.h). Equal ones serve up to eight contacts. A
// tray under hundreds of bodies would lend each of the few contacts that hold it up a hundredth of its mass, and sink through its
// table: so where contacts are many, half of the mass is shared out by what each contact pressed with as the substep began.
#ifndef SCREE_PHYSICS_CROWD_H
#define SCREE_PHYSICS_CROWD_H

#include "shaders/physics/arithmetic.h"
#include "shaders/physics/records.h"

LAWS_BEGIN

// Up to here parts are equal; of twice as many contacts half goes by what presses. With 4 the deepest penetration in a pile of
// ten thousand mixed bodies is 20 mm instead of 29, but loads shift the parts and parts the loads: it moves at 4 mm/s instead
// of 1.
CONSTANT float FEW_CONTACTS = 8.0f;
CONSTANT float LEAST_PRESSING = 1e-30f;  // N s; nothing is known of what presses

// Two numbers in one word: the contacts that carry, and what all of them press with, to one part in 128. Bits of a number that is
// neither denormal nor infinite, so a device may load and store it.
LAW float crowd_of(float carrying, float pressing) {
    uint contacts = uint(smaller(carrying, 65535.0f));
    return uintBitsToFloat((floatBitsToUint(clamped(pressing, LEAST_PRESSING, 1.0e30f)) & 0xFFFF0000u) | contacts);
}

// s, where the contact is lent the s-th part of the mass: max(1, contacts / 1.5) if the parts are equal.
LAW float split_for(float crowd, float pressed, Parameters parameters) {
    uint bits = floatBitsToUint(crowd);
    float contacts = float(bits & 0xFFFFu);
    float all = uintBitsToFloat(bits & 0xFFFF0000u);
    float split = contacts * parameters.inverse_relaxation;
    if (contacts > FEW_CONTACTS && all > 2.0f * LEAST_PRESSING) {
        float by_pressing = smaller(0.5f, (contacts - FEW_CONTACTS) * 0.0625f);
        float part = (1.0f - by_pressing) * reciprocal(contacts) + by_pressing * smaller(1.0f, pressed * reciprocal(all));
        split = parameters.inverse_relaxation * reciprocal(part);
    }
    return larger(1.0f, split);
}
LAW Mass lent(Mass mass, Impulse impulse, Parameters parameters) {
    mass.split = split_for(mass.split, impulse.pressed, parameters);
    return mass;
}

LAWS_END

#endif
