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
#include "shaders/physics/base/contact_impulse.h"
#include "shaders/physics/base/inertia.h"

LAWS_BEGIN

// What the shares of a body's contacts are made of, as a substep begins: each has equal + min(1/2, pressed * its normal impulse).
// Packed into a word, each as the upper half of a float, rounded down. The word is a float neither denormal nor infinite, so a
// device may load and store it. `normal_impulse`: of all contacts, N s.
CONSTANT float LEAST_PRESSING = 1e-30f;
LAW float pack_shares(float contacts, float normal_impulse) {
    float equal = reciprocal(larger(contacts, 1.0f));
    float pressed = 0.5f * reciprocal(clamped(normal_impulse, LEAST_PRESSING, 1.0e30f));
    equal = choose(contacts > 1.0f && normal_impulse > LEAST_PRESSING, 0.5f * equal, equal);
    return uintBitsToFloat((floatBitsToUint(pressed) & 0xFFFF0000u) | (floatBitsToUint(equal) >> 16u));
}

// What presses on a body as the substep begins, N s: 1/2 over this.
LAW float pressed_of(float shares) {
    return uintBitsToFloat(floatBitsToUint(shares) & 0xFFFF0000u);
}

// The split factor s of a contact, which solves with 1/s of the mass: max(1, contacts / 1.5) if the shares are equal; 1 for a
// body that no substep has begun with.
LAW float split_factor(float shares, float normal_sum, Parameters parameters) {
    float equal = uintBitsToFloat(floatBitsToUint(shares) << 16u);
    float share = choose(equal > 0.0f, equal + smaller(0.5f, pressed_of(shares) * normal_sum), 1.0f);
    return larger(1.0f, parameters.inverse_relaxation * reciprocal(share));
}
// Sum over the points, N s.
LAW float normal_impulse(Impulse impulse) {
    return (impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w);
}
LAW Mass split_mass(BodyMass body, Impulse impulse, Parameters parameters) {
    Mass mass = whole_mass(body);
    mass.split = split_factor(body.shares, impulse.normal_sum, parameters);
    return mass;
}

LAWS_END

#endif
