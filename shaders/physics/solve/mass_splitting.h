// Mass splitting: the share of a body's mass that each of its contacts solves with.
//
// The iteration converges for any shares that sum to 1 (contact_solver.h). Half of the mass is split equally, half in
// proportion to the normal impulses as the substep began: equal shares alone would give each of the few contacts that
// hold up a tray under hundreds of bodies a hundredth of its mass, and the tray would sink through its table. The
// deepest contacts of a pile, which bear most, become stiffer so (of ten thousand boxes the deepest penetrates 22 mm
// instead of 25).
#ifndef SCREE_PHYSICS_MASS_SPLITTING_H
#define SCREE_PHYSICS_MASS_SPLITTING_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/inertia.h"

LAWS_BEGIN

CONSTANT float LEAST_PRESSING = 1e-30f;  // N s; below, the impulses are unknown and shares are equal
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
