// Fast bodies and their sweeps through a step.
//
// A body is fast if it moves by more than half of its min_half_width in a step. A slower one cannot tunnel: it
// penetrates by that much at most, and its contact pushes it out of the side where it came in. Fast bodies take three
// measures: speculative contacts only for those that will meet (shaders/stages/continuous/predict_impacts.comp); after the last
// substep, clamping (continuous/clamping.h) where sweeps meet, or where a body leaves the bounds of its broadphase search.
#ifndef SCREE_PHYSICS_SWEEP_H
#define SCREE_PHYSICS_SWEEP_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/inertia.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/body/body_scale.h"

LAWS_BEGIN

// Time of impact of bodies that are not clamped; greater than 1, the value of fast bodies whose sweep is free.
CONSTANT float NO_HIT = 2.0f;

LAW float lever_of(BodyProperties properties) {
    return smaller(turning_reach(properties.shape, properties.size), bounding_radius(properties));
}

// Motion in a step above which a body is fast, m. With more, a thin plate could be entered beyond its middle.
LAW float ccd_threshold(BodyProperties properties) {
    return 0.5f * min_half_width(properties);
}
LAW bool in_motion(Velocity v) {
    return v.linear.x != 0.0f || v.linear.y != 0.0f || v.linear.z != 0.0f || v.angular.x != 0.0f || v.angular.y != 0.0f ||
           v.angular.z != 0.0f;
}
// Whether a body at this velocity will be fast, so that its doubtful contacts are left to the time of impact. Bodies on
// joints keep all of theirs, which hold most of them back without a clamp of the whole mechanism.
LAW bool will_be_fast(BodyProperties properties, Velocity velocity, Parameters parameters) {
    bool may_be = in_motion(velocity) && properties.joints == NONE && properties.motion != MOTION_FIXED;
    if (none(may_be)) return may_be;
    float way = length3(velocity.linear) + length3(velocity.angular) * lever_of(properties);
    return may_be && way * parameters.dt > ccd_threshold(properties);
}

// Marks of a sweep.
CONSTANT uint STRUCK = 1u;   // a contact will deflect the body
CONSTANT uint DRIVEN = 2u;   // a fast kinematic body, or one that outweighs it, will drive it
CONSTANT uint UNSOUND = 4u;  // its motion was not finite (quarantine.h)
// Whether the body drives what it meets further than the margin in which the broadphase searched for that. Nothing stops a
// kinematic body, so what is clamped before it would be left behind.
LAW bool drives(BodyProperties properties, Velocity velocity, Parameters parameters) {
    bool kinematic = properties.motion == MOTION_KINEMATIC;
    if (none(kinematic)) return kinematic;
    float way = length3(velocity.linear) + length3(velocity.angular) * lever_of(properties);
    return kinematic && way * parameters.dt > speculative_of(properties, parameters);
}
// Whether contacts of the body are to be predicted.
LAW bool will_sweep(BodyProperties properties, Velocity velocity, Parameters parameters) {
    return will_be_fast(properties, velocity, parameters) || drives(properties, velocity, parameters);
}

LAW vec3 half_extents_of(BodyProperties properties, vec4 orientation) {
    vec3 half_size = world_half_extents(properties.shape, properties.size, orientation);
    bool hull = properties.shape == SHAPE_HULL;
    return choose(hull, smaller3(half_size, vec3(bounding_radius(properties))), half_size);
}

// Difference of two quaternions on the shorter arc, whatever the sign of the second.
LAW vec4 turn_between(vec4 from, vec4 to) {
    float cosine = (from.x * to.x + from.y * to.y) + (from.z * to.z + from.w * to.w);
    return choose(cosine < 0.0f, -to - from, to - from);
}
// Bound on the angular speed if the quaternion goes straight from one orientation by `turn` to the other, rad per step:
// its angle p (half of the rotation) changes fastest midway, at twice the tangent of half of p: 2 |turn| over |from +
// to|.
LAW float turning_of(vec4 from, vec4 turn) {
    vec4 both = from * 2.0f + turn;
    float chord = (turn.x * turn.x + turn.y * turn.y) + (turn.z * turn.z + turn.w * turn.w);
    float sum = (both.x * both.x + both.y * both.y) + (both.z * both.z + both.w * both.w);
    return 4.0f * square_root(chord) * inverse_square_root(sum);
}

LAW Sweep sweep_of(Pose pose) {
    Sweep sweep;
    sweep.position = pose.position;
    sweep.pad0 = 0.0f;
    sweep.orientation = pose.orientation;
    sweep.stops[0] = floatBitsToUint(NO_HIT);
    sweep.stops[1] = floatBitsToUint(NO_HIT);
    sweep.marks = 0u;
    sweep.pad1 = 0u;
    return sweep;
}
LAWS_END

#endif
