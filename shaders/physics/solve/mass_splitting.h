// How a body's mass is shared out among the contacts that it has to bear.
//
// Mass splitting converges for any parts of a body's mass that sum to 1 (contact_solver.h). Half of the mass is shared out
// equally, half by what each contact pressed with as the substep began: equal parts alone would lend each of the few contacts
// that hold up a tray under hundreds of bodies a hundredth of its mass, and it would sink through its table; and in a pile the
// deepest contacts, which bear most, are stiffer so (of ten thousand boxes the deepest is 22 mm inside the other instead of 25).
//
// A contact is as soft as the parts that it is lent, so whatever changes the parts moves the bodies. Contacts that come and go at
// the edge of touching drove columns of ten boxes to and fro at 3 to 80 mm/s for ever. So the number of contacts among which a
// body is shared lags behind those that carry: it rises by a hundredth part a step (at once to what the iteration needs to
// converge), and falls by as much in four steps. One contact alone has the whole body at once: blows are exact.
#ifndef SCREE_PHYSICS_MASS_SPLITTING_H
#define SCREE_PHYSICS_MASS_SPLITTING_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

CONSTANT float LEAST_PRESSING = 1e-30f;  // N s; nothing is known of what presses
// Of the contacts that carry, how many must be counted at once. With 0.75 of them a relaxation of 1.5 is one of 2, where the
// iteration no longer converges.
CONSTANT float COUNTED_AT_ONCE = 0.77f;
// In so many steps the count falls by a unit in its eighth bit. With 1, columns beside a contact that flickers move at 3 mm/s.
CONSTANT uint FORGETTING_STEPS = 4u;

// Two numbers in one word, each the upper half of a float: how many contacts, and what all of them press with. Bits of a number
// that is neither denormal nor infinite, so a device may load and store it.
LAW float pack_split_state(float contacts, float normal_impulse) {
    uint count = (floatBitsToUint(contacts) + 0xFFFFu) >> 16u;  // rounded up
    return uintBitsToFloat((floatBitsToUint(clamped(normal_impulse, LEAST_PRESSING, 1.0e30f)) & 0xFFFF0000u) | count);
}
LAW float contact_count_of(float split_state) {
    return uintBitsToFloat(floatBitsToUint(split_state) << 16u);
}

// Once a step, before its first substep: the count drifts towards the contacts that carry.
LAW float update_hysteresis(float split_state, float carrying, uint steps) {
    uint was = floatBitsToUint(split_state) & 0xFFFFu;
    uint now = floatBitsToUint(pack_split_state(carrying, LEAST_PRESSING)) & 0xFFFFu;
    was = choose(was < now, was + 1u, choose(was > now && (steps & (FORGETTING_STEPS - 1u)) == 0u, was - 1u, was));
    return uintBitsToFloat((floatBitsToUint(split_state) & 0xFFFF0000u) | was);
}
LAW float split_state_after(float split_state, float carrying, float normal_impulse) {
    float counted = contact_count_of(split_state);
    bool afresh = carrying <= 1.0f || counted < 1.0f;
    return pack_split_state(choose(afresh, carrying, larger(counted, COUNTED_AT_ONCE * carrying)), normal_impulse);
}

// s, where the contact is lent the s-th part of the mass: max(1, contacts / 1.5) if the parts are equal.
LAW float split_factor(float split_state, float normal_sum, Parameters parameters) {
    float contacts = contact_count_of(split_state);
    float all = uintBitsToFloat(floatBitsToUint(split_state) & 0xFFFF0000u);
    float split = contacts * parameters.inverse_relaxation;
    bool weighed = contacts > 1.0f && 0.5f * all > LEAST_PRESSING;
    float part = 0.5f * reciprocal(contacts) + 0.5f * smaller(1.0f, normal_sum * reciprocal(all));
    split = choose(weighed, parameters.inverse_relaxation * reciprocal(part), split);
    return larger(1.0f, split);
}
// The sum over a contact's points, N s.
LAW float normal_impulse(Impulse impulse) {
    return (impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w);
}
LAW Mass split_mass(Mass mass, Impulse impulse, Parameters parameters) {
    mass.split = split_factor(mass.split, impulse.normal_sum, parameters);
    return mass;
}

LAWS_END

#endif
