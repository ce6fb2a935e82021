// Motion of one body: forces, world inertia, semi-implicit integration of velocity and pose.
#ifndef SCREE_PHYSICS_MOTION_H
#define SCREE_PHYSICS_MOTION_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/inertia.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

// Whether there is gravity. Without it no contact persists (persistence.h) and impulses have no momentum
// (contact_momentum.h).
LAW bool has_weight(Parameters parameters) {
    vec3 pull = absolute3(parameters.gravity);
    return pull.x > 1.0e-9f || pull.y > 1.0e-9f || pull.z > 1.0e-9f;
}

LAW BodyForces gravity_forces(BodyProperties properties, Parameters parameters) {
    BodyForces load;
    load.acceleration = choose(properties.motion == MOTION_DYNAMIC, parameters.gravity * properties.gravity_scale, vec3(0.0f));
    load.kept = 1.0f;
    load.angular_acceleration = vec3(0.0f);
    load.impacts = 0.0f;
    return load;
}

// Spheres, cubes, and bodies that contacts do not turn (inverse inertia 0).
LAW bool has_isotropic_inertia(BodyProperties properties) {
    return properties.inverse_inertia.x == properties.inverse_inertia.y &&
           properties.inverse_inertia.x == properties.inverse_inertia.z;
}

// The inverse mass and world inverse inertia tensor, R diag(i) R^T.
LAW Mass mass_in_world(BodyProperties properties, vec4 orientation) {
    Mass mass;
    mass.xx = properties.inverse_inertia.x;
    mass.yy = properties.inverse_inertia.x;
    mass.zz = properties.inverse_inertia.x;
    mass.xy = 0.0f;
    mass.xz = 0.0f;
    mass.yz = 0.0f;
    bool evenly = has_isotropic_inertia(properties);
    if (!none(!evenly)) {
        Mass tensor = tensor_in_world(axes_of(orientation), properties.inverse_inertia);
        mass.xx = choose(evenly, mass.xx, tensor.xx);
        mass.yy = choose(evenly, mass.yy, tensor.yy);
        mass.zz = choose(evenly, mass.zz, tensor.zz);
        mass.xy = choose(evenly, mass.xy, flush_least(tensor.xy));
        mass.xz = choose(evenly, mass.xz, flush_least(tensor.xz));
        mass.yz = choose(evenly, mass.yz, flush_least(tensor.yz));
    }
    mass.inverse_mass = properties.inverse_mass;
    mass.split = 1.0f;
    return mass;
}

CONSTANT float FARTHEST = 1.0e15f;  // m, m/s, rad/s: squares are finite

// Clamps a velocity to finite values, and to the greatest linear and angular speeds.
LAW Velocity clamp_velocity(Velocity velocity, Parameters parameters) {
    vec3 far = vec3(FARTHEST);
    velocity.linear = shortened(larger3(smaller3(velocity.linear, far), -far), parameters.max_speed);
    velocity.angular = shortened(larger3(smaller3(velocity.angular, far), -far), parameters.max_spin);
    return velocity;
}

// The velocity with which a step ends: beyond the limits as the last pass left it, but no further than twice, or the bounds of
// the next step reach over more cells than a device's loops have rounds for.
LAW Velocity held_velocity(Velocity velocity, Parameters parameters) {
    velocity.linear = shortened(velocity.linear, 2.0f * parameters.max_speed);
    velocity.angular = shortened(velocity.angular, 2.0f * parameters.max_spin);
    return velocity;
}

CONSTANT float UNSOUND = -1.0f;  // for BodyForces.kept

LAW bool is_within(vec3 v, float most) {
    return abs(v.x) <= most && abs(v.y) <= most && abs(v.z) <= most;
}
// Whether a velocity, a pose is finite, and such that it can be moved on. False for NaN (quarantine.h).
LAW bool is_sound(Velocity velocity) {
    return is_within(velocity.linear, FARTHEST) && is_within(velocity.angular, FARTHEST);
}
LAW bool is_sound(Pose pose) {
    vec4 q = pose.orientation;
    return is_within(pose.position, FARTHEST) && is_within(vec3(q.x, q.y, q.z), 2.0f) && abs(q.w) <= 2.0f;
}
// A velocity change, or 0 where it is not finite: the contact or joint that gives it marks the body in the same substep.
LAW float finite_or_none(float x) {
    return choose(abs(x) <= 3.0e38f, x, 0.0f);
}
LAW vec3 finite_or_none(vec3 v) {
    return vec3(finite_or_none(v.x), finite_or_none(v.y), finite_or_none(v.z));
}

// Whether a body rotates at the limit, or within 0.5% of it: gyroscopic torque changes a clamped velocity a little.
LAW bool is_spin_limited(Velocity velocity, Parameters parameters) {
    return dot3(velocity.angular, velocity.angular) > 0.99f * (parameters.max_spin * parameters.max_spin);
}

// Sets velocities and applies the user's impulses at the start of the step.
LAW Velocity apply_impulses(Velocity velocity, Action action, Mass mass, Parameters parameters) {
    bool sets = (action.flags & ACTION_SETS_VELOCITY) != 0u;
    velocity.linear = choose(sets, action.velocity, velocity.linear);
    velocity.angular = choose(sets, action.angular_velocity, velocity.angular);
    velocity.linear = velocity.linear + action.impulse * mass.inverse_mass;
    velocity.angular = velocity.angular + turned_by(mass, action.angular_impulse);
    return clamp_velocity(velocity, parameters);
}
// Adds the user's forces and torques to the accelerations of the whole step.
LAW BodyForces apply_forces(BodyForces load, Action action, Mass mass) {
    load.acceleration = load.acceleration + action.force * mass.inverse_mass;
    load.angular_acceleration = load.angular_acceleration + turned_by(mass, action.torque);
    return load;
}

// The velocity at the start of a substep: gravity, forces, implicit damping (v / (1 + h c)) and the contacts' changes.
// Damping acts on the velocity before those changes, which include the next warm start.
LAW Velocity integrate_velocity(Velocity velocity, Velocity change, BodyForces load, BodyProperties properties,
                                Parameters parameters) {
    float h = parameters.h;
    float keep = choose(properties.linear_damping > 0.0f, reciprocal(1.0f + h * properties.linear_damping), 1.0f);
    float keep_turning = choose(properties.angular_damping > 0.0f, reciprocal(1.0f + h * properties.angular_damping), 1.0f);
    Velocity after = velocity;
    after.linear = (velocity.linear + load.acceleration * h) * keep + finite_or_none(change.linear);
    after.angular = (velocity.angular + load.angular_acceleration * h) * keep_turning + finite_or_none(change.angular);
    after = clamp_velocity(after, parameters);
    after.linear = flush_tiny(after.linear);
    after.angular = flush_tiny(after.angular);
    return after;
}

// The orientation after rotating with `angular` (world, rad/s) for h seconds.
LAW vec4 turned(vec4 orientation, vec3 angular, float h) {
    vec3 half_turn = angular * (0.5f * h);
    // Normalisation yields an angle of atan(|half_turn|); one more term of the tangent's series corrects that to third
    // order.
    half_turn = half_turn * (1.0f + 0.33333333f * dot3(half_turn, half_turn));
    vec3 axis = vec3(orientation.x, orientation.y, orientation.z);
    vec3 spin = half_turn * orientation.w + cross3(half_turn, axis);
    return unit_quaternion(orientation + vec4(spin, -dot3(half_turn, axis)));
}

struct RigidState {
    Pose pose;
    Velocity velocity;
};
// Adds h v to the position with Kahan compensation; the low-order term is stored with pose and velocity.
LAW RigidState integrate_position(Pose pose, Velocity velocity, float h) {
    vec3 way = velocity.linear * h + vec3(pose.low_x, velocity.low_y, velocity.low_z);
    RigidState after;
    after.pose = pose;
    after.velocity = velocity;
    after.pose.position = pose.position + way;
    vec3 low = way - (after.pose.position - pose.position);
    after.pose.low_x = low.x;
    after.velocity.low_y = low.y;
    after.velocity.low_z = low.z;
    return after;
}

// Angular velocity of a body of angular momentum L: w = R I^-1 R^T L.
LAW vec3 angular_velocity_of(vec4 orientation, vec3 momentum, vec3 inverse_inertia) {
    vec3 l = rotate_back(orientation, momentum);
    return rotate(orientation, vec3(l.x * inverse_inertia.x, l.y * inverse_inertia.y, l.z * inverse_inertia.z));
}

// One substep of free motion with gyroscopic torque. The angular momentum L = R I R^T w is conserved while the body
// rotates, so w follows from L at the middle of the substep (explicit midpoint, second order) and at its end.
// Torque-free tumbling conserves L to rounding, and the rotational energy stays between L^2 / 2 I_max and L^2 / 2 I_min
// whatever h. Only the change of w is computed from L: the rounding of w itself would add up in one direction, 1e-7 in
// every substep.
LAW RigidState integrate(Pose pose, Velocity velocity, BodyProperties properties, float h) {
    RigidState after = integrate_position(pose, velocity, h);
    bool tumbles = properties.motion == MOTION_DYNAMIC && !has_isotropic_inertia(properties);
    if (none(tumbles)) {
        after.pose.orientation = turned(pose.orientation, velocity.angular, h);
        return after;
    }
    vec3 i = properties.inverse_inertia;
    vec3 spin = rotate_back(pose.orientation, velocity.angular);
    vec3 momentum = rotate(pose.orientation, vec3(spin.x * reciprocal(i.x), spin.y * reciprocal(i.y), spin.z * reciprocal(i.z)));
    vec3 at_first = angular_velocity_of(pose.orientation, momentum, i);
    vec4 middle = turned(pose.orientation, velocity.angular, 0.5f * h);
    vec3 halfway = velocity.angular + (angular_velocity_of(middle, momentum, i) - at_first);
    after.pose.orientation = turned(pose.orientation, choose(tumbles, halfway, velocity.angular), h);
    vec3 at_last = velocity.angular + (angular_velocity_of(after.pose.orientation, momentum, i) - at_first);
    after.velocity.angular = choose(tumbles, flush_tiny(at_last), velocity.angular);
    return after;
}

// The state after a substep where that is sound, else the body at rest where it was.
LAW RigidState moved_soundly(bool sound, Pose before, RigidState after) {
    after.pose.position = choose(sound, after.pose.position, before.position);
    after.pose.low_x = choose(sound, after.pose.low_x, before.low_x);
    after.pose.orientation = choose(sound, after.pose.orientation, before.orientation);
    after.velocity.linear = choose(sound, after.velocity.linear, vec3(0.0f));
    after.velocity.low_y = choose(sound, after.velocity.low_y, 0.0f);
    after.velocity.angular = choose(sound, after.velocity.angular, vec3(0.0f));
    after.velocity.low_z = choose(sound, after.velocity.low_z, 0.0f);
    return after;
}

LAWS_END

#endif
