// Mass splitting: the share of a body's mass that each of its contacts solves with.
//
// The iteration converges for any shares that sum to 1 (contact_solver.h). Half of the mass is split equally, half in
// proportion to the normal impulses as the substep began: equal shares alone would give each of the few contacts that
// hold up a tray under hundreds of bodies a hundredth of its mass, and the tray would sink through its table. The
// deepest contacts of a pile, which bear most, become stiffer so (of ten thousand boxes the deepest penetrates 22 mm
// instead of 25).
//
// A contact is as soft as its split masses, so bodies move whenever the shares change. Contacts that come and go drove
// columns of ten boxes to and fro at 3 to 80 mm/s for ever. So the contact count of a body follows its active contacts
// with hysteresis: it rises by about 1% a step (at once to what the iteration needs to converge), and falls by as much
// in four steps. A single contact has the whole body at once, so impacts are exact.
#ifndef SCREE_PHYSICS_MASS_SPLITTING_H
#define SCREE_PHYSICS_MASS_SPLITTING_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/inertia.h"

LAWS_BEGIN

CONSTANT float LEAST_PRESSING = 1e-30f;  // N s; below, the impulses are unknown and shares are equal
// The part of the active contacts that the count reaches at once. With 0.75 a relaxation of 1.5 acts as one of 2, where
// the iteration no longer converges.
CONSTANT float COUNTED_AT_ONCE = 0.77f;
// Steps in which the count falls by one unit of its eighth bit. With 1, columns beside a flickering contact move at 3
// mm/s.
CONSTANT uint FORGETTING_STEPS = 4u;

// Packs two numbers into a word, each as the upper half of a float: the contact count and the sum of the normal
// impulses. The word is a float neither denormal nor infinite, so a device may load and store it.
LAW float pack_split_state(float contacts, float normal_impulse) {
    uint count = (floatBitsToUint(contacts) + 0xFFFFu) >> 16u;  // rounded up
    return uintBitsToFloat((floatBitsToUint(clamped(normal_impulse, LEAST_PRESSING, 1.0e30f)) & 0xFFFF0000u) | count);
}
LAW float contact_count_of(float split_state) {
    return uintBitsToFloat(floatBitsToUint(split_state) << 16u);
}

// Sum of the normal impulses of a body's contacts as the substep began, N s.
LAW float normal_impulses_of(float split_state) {
    return uintBitsToFloat(floatBitsToUint(split_state) & 0xFFFF0000u);
}

// Once a step, before its first substep: the count moves by one unit towards the number of active contacts.
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

// The split factor s of a contact, which solves with 1/s of the mass: max(1, contacts / 1.5) if the shares are equal.
LAW float split_factor(float split_state, float normal_sum, Parameters parameters) {
    float contacts = contact_count_of(split_state);
    float all = normal_impulses_of(split_state);
    float split = contacts * parameters.inverse_relaxation;
    bool weighed = contacts > 1.0f && 0.5f * all > LEAST_PRESSING;
    float part = 0.5f * reciprocal(contacts) + 0.5f * smaller(1.0f, normal_sum * reciprocal(all));
    split = choose(weighed, parameters.inverse_relaxation * reciprocal(part), split);
    return larger(1.0f, split);
}
// Sum over the points, N s.
LAW float normal_impulse(Impulse impulse) {
    return (impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w);
}
LAW Mass split_mass(BodyMass body, Impulse impulse, Parameters parameters) {
    Mass mass = whole_mass(body);
    mass.split = split_factor(body.split_state, impulse.normal_sum, parameters);
    return mass;
}

LAWS_END

#endif
