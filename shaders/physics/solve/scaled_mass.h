// The record of a body's mass with its scale (mass_scaling.h): inverse mass and inverse inertia are divided by it.
#ifndef SCREE_PHYSICS_SCALED_MASS_H
#define SCREE_PHYSICS_SCALED_MASS_H

#include "shaders/physics/solve/motion.h"

LAWS_BEGIN

CONSTANT float GREATEST_SCALE = 4096.0f;
// A scale has five bits after its leading one, and changes by units of the last: 1.6 to 3.1%.
CONSTANT uint SCALE_SHIFT = 18u;

LAW float scale_from(uint code) {
    return uintBitsToFloat(code << SCALE_SHIFT);
}
// The scale that a body's record of mass has, at least 1.
LAW float mass_scale(BodyMass mass, BodyProperties properties) {
    bool scaled = mass.inverse_mass > 0.0f && mass.inverse_mass < properties.inverse_mass;
    if (none(scaled)) return 1.0f;
    float ratio = properties.inverse_mass * reciprocal(choose(scaled, mass.inverse_mass, 1.0f));
    uint code = (floatBitsToUint(smaller(ratio, GREATEST_SCALE)) + (1u << (SCALE_SHIFT - 1u))) >> SCALE_SHIFT;
    return choose(scaled, scale_from(code), 1.0f);
}
LAW Mass scaled_mass(Mass mass, float scale) {
    bool scaled = scale > 1.0f;
    if (none(scaled)) return mass;
    float part = choose(scaled, reciprocal(scale), 1.0f);
    mass.xx = mass.xx * part;
    mass.xy = flush_least(mass.xy * part);
    mass.xz = flush_least(mass.xz * part);
    mass.yy = mass.yy * part;
    mass.yz = flush_least(mass.yz * part);
    mass.zz = mass.zz * part;
    mass.inverse_mass = mass.inverse_mass * part;
    return mass;
}
// The record of a body's mass at an orientation: with that scale, and with the scale that it has.
LAW BodyMass mass_with_scale(BodyMass mass, BodyProperties properties, vec4 orientation, float scale) {
    return body_mass(scaled_mass(mass_in_world(properties, orientation), scale), mass.split_state);
}
LAW BodyMass mass_with_scale_of(BodyMass mass, BodyProperties properties, vec4 orientation) {
    return mass_with_scale(mass, properties, orientation, mass_scale(mass, properties));
}
// Accelerations of a body whose weight and forces act on the scaled mass.
LAW BodyForces scaled_forces(BodyForces load, float scale) {
    bool scaled = scale > 1.0f;
    if (none(scaled)) return load;
    float part = choose(scaled, reciprocal(scale), 1.0f);
    load.acceleration = load.acceleration * part;
    load.angular_acceleration = load.angular_acceleration * part;
    return load;
}

LAWS_END

#endif
