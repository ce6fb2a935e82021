// The record of a body's mass with its scale (mass_scaling.h): inverse mass and inverse inertia are divided by it.
#ifndef SCREE_PHYSICS_SCALED_MASS_H
#define SCREE_PHYSICS_SCALED_MASS_H

#include "shaders/physics/solve/motion.h"

LAWS_BEGIN

CONSTANT float GREATEST_SCALE = 4096.0f;
// A scale has five bits after its leading one, and changes by units of the last: 1.6 to 3.1%.
CONSTANT uint SCALE_SHIFT = 18u;
// The low-pass filter (mass_scaling.h): part of its lag that it makes up for in a substep, and the least acceleration that
// counts, of that by weight and forces.
CONSTANT float FOLLOWING = 0.01f;
CONSTANT float LEAST_ACCELERATION = 0.02f;

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

struct ScaledChange {
    Velocity change;  // of the body's velocity in this substep
    ScaledMotion motion;
};
// Adds to a scaled body's change of velocity what keeps its acceleration along that of its weight and forces. `now`: its velocity
// before the substep.
LAW ScaledChange with_acceleration(Velocity change, Velocity now, ScaledMotion motion, BodyForces load, float scale,
                                   Parameters parameters) {
    vec3 lag = now.linear - motion.linear, pull = load.acceleration;
    float squared = dot3(pull, pull);
    bool pulled = squared > 1.0e-12f;
    float along = choose(pulled, dot3(pull, lag) * reciprocal(choose(pulled, squared, 1.0f)), 0.0f);
    bool follows = scale > 1.0f && !(motion.waits > 0.0f);
    bool counts = follows && abs(along) * (FOLLOWING * parameters.inverse_h) > LEAST_ACCELERATION;
    float part = FOLLOWING * (1.0f - reciprocal(scale));
    ScaledChange after;
    after.change = change;
    after.change.linear = choose(counts, change.linear + pull * (along * part), change.linear);
    after.motion = motion;
    after.motion.linear = choose(follows, flush_tiny(motion.linear + lag * FOLLOWING), now.linear);
    return after;
}

LAWS_END

#endif
