// Motion of one body: forces, world inertia, semi-implicit integration of velocity and pose.
#ifndef SCREE_PHYSICS_MOTION_H
#define SCREE_PHYSICS_MOTION_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/inertia.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

// Whether there is gravity. Without it no contact persists (persistence.h).
LAW bool has_weight(Parameters parameters) {
    vec3 pull = absolute3(parameters.gravity);
    return pull.x > 1.0e-9f || pull.y > 1.0e-9f || pull.z > 1.0e-9f;
}

LAW BodyForces gravity_forces(BodyProperties properties, Parameters parameters) {
    BodyForces load;
    vec3 gravity = flush_tiny(parameters.gravity * properties.gravity_scale);
    load.acceleration = choose(properties.motion == MOTION_DYNAMIC, gravity, vec3(0.0f));
    load.kept = 1.0f;
    load.angular_acceleration = vec3(0.0f);
    load.impact_weight = 0.0f;
    return load;
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

// The velocity with which a body moves and a step ends: beyond the limits as the last pass left it, but no further than twice.
// A spring or motor at the end of its range throws bodies out of any scene in one substep otherwise, and the bounds of the next
// step reach over more cells than a device's loops have rounds for. What is not a number stays so (quarantine.h).
LAW Velocity held_velocity(Velocity velocity, Parameters parameters) {
    vec3 far = vec3(FARTHEST);
    velocity.linear = larger3(-far, smaller3(far, velocity.linear));
    velocity.angular = larger3(-far, smaller3(far, velocity.angular));
    velocity.linear = shortened(velocity.linear, 2.0f * parameters.max_speed);
    velocity.angular = shortened(velocity.angular, 2.0f * parameters.max_spin);
    return velocity;
}

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

// The record of a body's mass at an orientation.
LAW BodyMass turned_mass(BodyMass mass, BodyProperties properties, vec4 orientation) {
    return body_mass(mass_in_world(properties, orientation), mass.shares);
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

// R(to) v - R(from) v for unit quaternions, rounded as the difference is and not as v.
LAW vec3 turn_between(vec4 from, vec4 to, vec3 v) {
    vec4 change = to + -from;
    vec3 axis = vec3(from.x, from.y, from.z), axis_to = vec3(to.x, to.y, to.z), axis_change = vec3(change.x, change.y, change.z);
    // R v = v + 2 u x (u x v + w v)
    vec3 arm_to = cross3(axis_to, v) + v * to.w, arm_change = cross3(axis_change, v) + v * change.w;
    return (cross3(axis_change, arm_to) + cross3(axis, arm_change)) * 2.0f;
}

// A unit quaternion to half the rounding of unit_quaternion, whose lengths are too great or too small for many steps on end:
// a plate at 300 rad/s lost 5e-4 of its angular momentum in 30 s, and loses 6e-5.
LAW vec4 unit_to_rounding(vec4 q) {
    q = unit_quaternion(q);
    float excess = ((q.x * q.x + q.y * q.y) + (q.z * q.z + q.w * q.w)) - 1.0f;
    return flush_tiny(q + q * (-0.5f * excess));
}

// Rotation by an angle of 2 x as an unnormalised quaternion (half_sine(x) axis, half_cosine(x)): Pade's approximant of the
// tangent, x (15 - x^2) / (15 - 6 x^2), which errs by 1e-3 of a radian at x = 1; rotations end short of a half turn.
LAW float half_sine(float x) {
    return x * (1.0f - 0.066666667f * (x * x));
}
LAW float half_cosine(float x) {
    return larger(1.0f - 0.4f * (x * x), 0.05f);
}

// The orientation after a rotation about axes of the body and one about axes of the world. `own`: half the rotation's tangent
// (x, y, z of its quaternion over w), `half_angle`: half the rotation, rad.
LAW vec4 turned_and_precessed(vec4 orientation, vec3 own, vec3 half_angle) {
    vec3 axis = vec3(orientation.x, orientation.y, orientation.z);
    vec4 turned_own = orientation + vec4(own * orientation.w + cross3(axis, own), -dot3(own, axis));
    float squared = dot3(half_angle, half_angle);
    vec3 precession = half_angle * ((1.0f - 0.066666667f * squared) * reciprocal(larger(1.0f - 0.4f * squared, 0.05f)));
    axis = vec3(turned_own.x, turned_own.y, turned_own.z);
    return unit_to_rounding(turned_own + vec4(precession * turned_own.w + cross3(precession, axis), -dot3(precession, axis)));
}

// The inverse moment of inertia, relative to the next, above which a body is slender: at ten times that, rounding of L already
// doubles the change of energy.
CONSTANT float SLENDER = 1.0e4f;

struct FreeTurn {
    vec4 orientation;
    vec3 spin_gain;  // change of the angular velocity in the body's axes, rad/s
};
// A torque-free body after h seconds. `p`: its angular momentum in its own axes, `momentum`: in the world's. Splitting of the
// kinetic energy (McLachlan 1993; Reich 1994; Dullweber, Leimkuhler and McLachlan, J. Chem. Phys. 107, 1997). With the inverse
// moments i_k >= i_j >= i_a, 2 T = i_j p^2 + (i_a - i_j) p_a^2 + (i_k - i_j) p_k^2: a rotation about L, one about the body's
// axis a, and, in two halves around them, one about its axis k. Each is exact, symplectic and conserves L. With two equal
// moments they commute, and the energy is conserved too; with three its error is bounded.
//
// The new p is L in the new axes: then rounding of the orientation does not add up in L. But about the axis k of a slender
// body p is what the rotations make it: rounding of L, which i_k magnifies, would turn it about that axis ever faster (moments
// of 1e-6 : 1 : 1 at 30 rad/s: energy times 5 in 30 s). There L changes with the orientation's rounding: in 30 s at 1 rad/s by
// 7e-5 of the greatest moment times the speed, where bodies that are not slender lose 5e-6.
LAW FreeTurn tumbled(vec4 orientation, vec3 p, vec3 momentum, vec3 inverse_inertia, float h) {
    vec3 i = inverse_inertia;
    bool k_is_x = i.x >= i.y && i.x >= i.z;
    bool k_is_y = !k_is_x && i.y >= i.z;
    bool k_is_z = !k_is_x && !k_is_y;
    bool a_is_z = !k_is_z && i.z <= i.x && i.z <= i.y;
    bool a_is_y = !a_is_z && !k_is_y && i.y <= i.x;
    bool a_is_x = !a_is_z && !a_is_y;
    // The third axis n = k x a, along a body's axis or against it.
    bool along = (k_is_x && a_is_y) || (k_is_y && a_is_z) || (k_is_z && a_is_x);
    float i_k = choose(k_is_x, i.x, choose(k_is_y, i.y, i.z)), i_a = choose(a_is_x, i.x, choose(a_is_y, i.y, i.z));
    float i_j = choose(k_is_x || a_is_x, choose(k_is_y || a_is_y, i.z, i.y), i.x);
    float p_k = choose(k_is_x, p.x, choose(k_is_y, p.y, p.z)), p_a = choose(a_is_x, p.x, choose(a_is_y, p.y, p.z));
    float third = choose(k_is_x || a_is_x, choose(k_is_y || a_is_y, p.z, p.y), p.x);
    float p_n = choose(along, third, -third);

    float x = 0.25f * h * ((i_k - i_j) * p_k);
    float s1 = half_sine(x), c1 = half_cosine(x);
    float scale = reciprocal(c1 * c1 + s1 * s1);
    float cosine = (c1 * c1 - s1 * s1) * scale, sine = 2.0f * (s1 * c1) * scale;
    float p_a1 = cosine * p_a + sine * p_n, p_n1 = cosine * p_n - sine * p_a;
    x = 0.5f * h * ((i_a - i_j) * p_a1);
    float s2 = half_sine(x), c2 = half_cosine(x);
    scale = reciprocal(c2 * c2 + s2 * s2);
    float gain_k = -(2.0f * s2 * scale) * (s2 * p_k + c2 * p_n1);
    x = 0.25f * h * ((i_k - i_j) * (p_k + gain_k));
    float s3 = half_sine(x), c3 = half_cosine(x);

    // The product of the three rotations about body axes: about k, a and k. Divided by its scalar part: what is added to the
    // orientation is rounded, and not the orientation with it.
    float part = reciprocal(c2 * larger(c1 * c3 - s1 * s3, 0.05f));
    float about_k = c2 * (s1 * c3 + c1 * s3) * part, about_a = s2 * (c1 * c3 + s1 * s3) * part;
    float about_n = s2 * (s1 * c3 - c1 * s3) * part;
    about_n = choose(along, about_n, -about_n);
    vec3 own =
        vec3(choose(k_is_x, about_k, choose(a_is_x, about_a, about_n)), choose(k_is_y, about_k, choose(a_is_y, about_a, about_n)),
             choose(k_is_z, about_k, choose(a_is_z, about_a, about_n)));
    FreeTurn after;
    after.orientation = turned_and_precessed(orientation, own, momentum * (0.5f * h * i_j));
    vec3 gain = turn_between(conjugate(orientation), conjugate(after.orientation), momentum);
    bool slender = i_k > SLENDER * i_j;
    gain = vec3(choose(slender && k_is_x, gain_k, gain.x), choose(slender && k_is_y, gain_k, gain.y),
                choose(slender && k_is_z, gain_k, gain.z));
    after.spin_gain = vec3(gain.x * i.x, gain.y * i.y, gain.z * i.z);
    return after;
}

// One substep of free motion with gyroscopic torque. The angular momentum L = R I R^T w is conserved while the body rotates,
// so w at the end follows from L. Only the change of w is computed from L: the rounding of w itself would add up in one
// direction, 1e-7 in every substep.
LAW RigidState integrate(Pose pose, Velocity velocity, BodyProperties properties, float h) {
    RigidState after = integrate_position(pose, velocity, h);
    bool tumbles = properties.motion == MOTION_DYNAMIC && !has_isotropic_inertia(properties);
    after.pose.orientation = turned(pose.orientation, velocity.angular, h);
    if (none(tumbles)) return after;
    vec3 i = properties.inverse_inertia;
    vec3 spin = rotate_back(pose.orientation, velocity.angular);
    vec3 p = vec3(spin.x * reciprocal(i.x), spin.y * reciprocal(i.y), spin.z * reciprocal(i.z));
    FreeTurn turn = tumbled(pose.orientation, p, rotate(pose.orientation, p), i, h);
    after.pose.orientation = choose(tumbles, turn.orientation, after.pose.orientation);
    vec3 change = turn_between(pose.orientation, turn.orientation, spin) + rotate(turn.orientation, turn.spin_gain);
    after.velocity.angular = choose(tumbles, flush_tiny(velocity.angular + change), velocity.angular);
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
