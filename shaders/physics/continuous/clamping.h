// Clamping: bodies that are fast stop at their time of impact, or where they leave the bounds of their broadphase search.
//
// A clamped body keeps its velocity and moves on in the next step, which finds its contact (as in Box2D and Box3D: Erin
// Catto, Continuous Collision, GDC 2013). Bodies on joints are clamped together, at the earliest time of impact of any
// (share_stops.comp): one alone would tear its joint open (limbs of falling figures were 0.5 m apart).
#ifndef SCREE_PHYSICS_CLAMPING_H
#define SCREE_PHYSICS_CLAMPING_H

#include "shaders/physics/body/sweep.h"

LAWS_BEGIN

// Rounds of time of impact. The first finds who meets whom, the second who runs into bodies clamped by the first, and
// so on: with fewer, bodies that fly in a row pass each other when the first of them is clamped.
CONSTANT uint CCD_ROUNDS = 3u;

// A body outweighs one of at most this part of its mass: what it strikes goes with it.
CONSTANT float LIGHT_PART = 0.125f;
LAW bool outweighs(BodyProperties heavy, BodyProperties light) {
    return heavy.motion == MOTION_DYNAMIC && light.motion == MOTION_DYNAMIC && light.joints == NONE &&
           heavy.inverse_mass <= LIGHT_PART * light.inverse_mass;
}
// Whether a pair may clamp the one body, `body`, by the other. A contact of the pair pushes what is driven ahead, though that
// may lag behind by a part of a substep; of two that are driven both, neither is left behind for the other.
LAW bool may_clamp(float stop, uint marks, BodyProperties body, uint other_marks, BodyProperties other, uint contact_points) {
    bool driven = (marks & DRIVEN) != 0u, other_driven = (other_marks & DRIVEN) != 0u;
    bool pushes = (driven && other.motion == MOTION_KINEMATIC) || (driven && other_driven) || outweighs(body, other) ||
                  outweighs(other, body);
    return stop <= 1.0f && !(pushes && contact_points > 0u);
}
LAW Sweep stopped_at(Sweep sweep, float fraction) {
    sweep.stops[0] = floatBitsToUint(fraction);
    sweep.stops[1] = floatBitsToUint(fraction);
    return sweep;
}
LAW float stop_of(Sweep sweep) {
    return smaller(uintBitsToFloat(sweep.stops[0]), uintBitsToFloat(sweep.stops[1]));
}

LAW bool was_fast(BodyProperties properties, Sweep sweep, Pose end) {
    vec4 turn = turn_between(sweep.orientation, end.orientation);
    float way = length3(end.position - sweep.position) + turning_of(sweep.orientation, turn) * lever_of(properties);
    return way > ccd_threshold(properties);
}

#ifndef SCREE_LANES  // the rest has branches

// The fraction of a displacement `way` along one axis, by a body that grows by `growth` along that axis as it turns, for which it
// stays within the room behind and before it, m. Always greater than 0 if there is room at the start: a body that is held where
// it was would be held there for ever.
LAW float part_within(float way, float growth, float back, float ahead) {
    float room = way > 0.0f ? ahead : back;
    float length = abs(way) + growth;
    if (length <= room) return 1.0f;
    return room > 1.0e-9f ? room * reciprocal(length) : 0.0f;
}
// The fraction of its sweep after which a body leaves the bounds of its broadphase search by more than ccd_threshold; 1
// if it stays within. Beyond, a ricochet could pass bodies that it was not paired with. But a body that rested and is
// driven by a fast kinematic body must keep ahead of that, and what collides with nothing is searched for nowhere.
LAW float seen_part(BodyProperties properties, Sweep sweep, Pose end, Bounds bounds) {
    if ((sweep.marks & DRIVEN) != 0u || (properties.flags & ROW_APART) != 0u) return 1.0f;
    vec3 half_size = half_extents_of(properties, sweep.orientation);
    vec3 growth = larger3(half_extents_of(properties, end.orientation) - half_size, vec3(0.0f));
    half_size = half_size - vec3(ccd_threshold(properties));
    vec3 back = (sweep.position - half_size) - bounds.lower;
    vec3 ahead = bounds.upper - (sweep.position + half_size);
    vec3 way = end.position - sweep.position;
    float part = part_within(way.x, growth.x, back.x, ahead.x);
    part = smaller(part, part_within(way.y, growth.y, back.y, ahead.y));
    return smaller(part, part_within(way.z, growth.z, back.z, ahead.z));
}

LAW Pose pose_along(vec3 position, vec3 way, vec4 orientation, vec4 turn, float fraction) {
    Pose pose;
    pose.position = position + way * fraction;
    pose.low_x = 0.0f;
    pose.orientation = unit_quaternion(orientation + turn * fraction);
    return pose;
}

struct ClampedMotion {
    Pose pose;
    Velocity velocity;
};
// The angular velocity that belongs to another orientation of the body, with its energy and the direction of its angular
// momentum.
LAW vec3 spin_in(vec4 orientation, vec4 was, vec3 angular, vec3 inverse_inertia) {
    vec3 i = inverse_inertia, spin = rotate_back(was, angular);
    vec3 momentum = vec3(spin.x * reciprocal(i.x), spin.y * reciprocal(i.y), spin.z * reciprocal(i.z));
    float energy = dot3(spin, momentum);
    momentum = rotate_back(orientation, rotate(was, momentum));
    spin = vec3(momentum.x * i.x, momentum.y * i.y, momentum.z * i.z);
    float found = dot3(spin, momentum);
    if (found < 1.0e-30f || energy < 1.0e-30f) return angular;
    return rotate(orientation, spin) * square_root(energy * reciprocal(found));
}

// The body clamped to a fraction of its sweep. The velocity stays, less what gravity and forces added on the omitted
// part: v^2 - 2 a.x, so clamping conserves energy. The angular velocity follows the orientation, but of bodies on joints, whose
// motion is not free (gaps in falling ragdolls grew by a third).
LAW ClampedMotion clamp_motion(Sweep sweep, Pose end, Velocity velocity, BodyProperties body, BodyForces load, float fraction) {
    ClampedMotion after;
    after.pose = pose_along(sweep.position, end.position - sweep.position, sweep.orientation,
                            turn_between(sweep.orientation, end.orientation), fraction);
    after.velocity = velocity;
    after.velocity.low_y = 0.0f;
    after.velocity.low_z = 0.0f;
    float work = 2.0f * dot3(load.acceleration, end.position - after.pose.position);
    float squared = dot3(velocity.linear, velocity.linear);
    if (abs(work) > 1.0e-6f * squared && abs(work) < 0.5f * squared)
        after.velocity.linear = velocity.linear * square_root((squared - work) * reciprocal(squared));
    if (body.motion == MOTION_DYNAMIC && body.joints == NONE && !has_isotropic_inertia(body))
        after.velocity.angular =
            flush_tiny(spin_in(after.pose.orientation, end.orientation, velocity.angular, body.inverse_inertia));
    return after;
}

#endif

LAWS_END

#endif
