// How one body moves: what pushes it, its inertia in the world, its velocity and pose after a substep.
#ifndef SCREE_PHYSICS_MOTION_H
#define SCREE_PHYSICS_MOTION_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/inertia.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

LAW Load gravity_load(Traits traits, Parameters parameters) {
    Load load;
    load.acceleration = choose(traits.motion == MOTION_DYNAMIC, parameters.gravity * traits.gravity_scale, vec3(0.0f));
    load.kept = 1.0f;
    load.angular_acceleration = vec3(0.0f);
    load.blows = 0.0f;
    return load;
}

// The same about every axis: spheres, cubes, and bodies that contacts do not turn.
LAW bool turns_evenly(Traits traits) {
    return traits.inverse_inertia.x == traits.inverse_inertia.y && traits.inverse_inertia.x == traits.inverse_inertia.z;
}

LAW Mass mass_in_world(Traits traits, vec4 orientation, float split) {
    Mass mass;
    mass.xx = traits.inverse_inertia.x;
    mass.yy = traits.inverse_inertia.x;
    mass.zz = traits.inverse_inertia.x;
    mass.xy = 0.0f;
    mass.xz = 0.0f;
    mass.yz = 0.0f;
    bool evenly = turns_evenly(traits);
    if (!none(!evenly)) {
        Mass tensor = tensor_in_world(axes_of(orientation), traits.inverse_inertia);
        mass.xx = choose(evenly, mass.xx, tensor.xx);
        mass.yy = choose(evenly, mass.yy, tensor.yy);
        mass.zz = choose(evenly, mass.zz, tensor.zz);
        mass.xy = choose(evenly, mass.xy, tensor.xy);
        mass.xz = choose(evenly, mass.xz, tensor.xz);
        mass.yz = choose(evenly, mass.yz, tensor.yz);
    }
    mass.inverse_mass = traits.inverse_mass;
    mass.split = split;
    return mass;
}

// A velocity that is finite and within the speeds that a step can handle, whatever pushed the body.
LAW Velocity limited(Velocity velocity, Parameters parameters) {
    vec3 far = vec3(1.0e15f);  // its square is finite
    velocity.linear = shortened(larger3(smaller3(velocity.linear, far), -far), parameters.max_speed);
    velocity.angular = shortened(larger3(smaller3(velocity.angular, far), -far), parameters.max_spin);
    return velocity;
}

// Impulses at the start of the step, forces into the load of the whole step.
LAW Velocity kicked(Velocity velocity, Action action, Mass mass, Parameters parameters) {
    bool sets = (action.flags & ACTION_SETS_VELOCITY) != 0u;
    velocity.linear = choose(sets, action.velocity, velocity.linear);
    velocity.angular = choose(sets, action.angular_velocity, velocity.angular);
    velocity.linear = velocity.linear + action.impulse * mass.inverse_mass;
    velocity.angular = velocity.angular + turned_by(mass, action.angular_impulse);
    return limited(velocity, parameters);
}
LAW Load loaded(Load load, Action action, Mass mass) {
    load.acceleration = load.acceleration + action.force * mass.inverse_mass;
    load.angular_acceleration = load.angular_acceleration + turned_by(mass, action.torque);
    return load;
}

// The velocity at the start of a substep: gravity, forces and damping (implicit: v / (1 + h c)), and what the contacts decided.
// Damping sees the velocity before the contacts' changes, which arrive together with their next warm start.
LAW Velocity accelerated(Velocity velocity, Velocity change, Load load, Traits traits, Parameters parameters) {
    float h = parameters.h;
    float keep = choose(traits.linear_damping > 0.0f, reciprocal(1.0f + h * traits.linear_damping), 1.0f);
    float keep_turning = choose(traits.angular_damping > 0.0f, reciprocal(1.0f + h * traits.angular_damping), 1.0f);
    Velocity after = velocity;
    after.linear = (velocity.linear + load.acceleration * h) * keep + change.linear;
    after.angular = (velocity.angular + load.angular_acceleration * h) * keep_turning + change.angular;
    after = limited(after, parameters);
    after.linear = without_dust(after.linear);
    after.angular = without_dust(after.angular);
    return after;
}

LAW vec4 turned(vec4 orientation, vec3 angular, float h) {
    vec3 half_turn = angular * (0.5f * h);
    // The quaternion's angle is the arctangent of this; the next term of the tangent's series makes up for it.
    half_turn = half_turn * (1.0f + 0.33333333f * dot3(half_turn, half_turn));
    vec3 axis = vec3(orientation.x, orientation.y, orientation.z);
    vec3 spin = half_turn * orientation.w + cross3(half_turn, axis);
    return unit_quaternion(orientation + vec4(spin, -dot3(half_turn, axis)));
}

struct Moved {
    Pose pose;
    Velocity velocity;
};
// The centre goes on by h v, with the rest of the sum kept for the next time.
LAW Moved carried(Pose pose, Velocity velocity, float h) {
    vec3 way = velocity.linear * h + vec3(pose.rest_x, velocity.rest_y, velocity.rest_z);
    Moved after;
    after.pose = pose;
    after.velocity = velocity;
    after.pose.position = pose.position + way;
    vec3 rest = way - (after.pose.position - pose.position);
    after.pose.rest_x = rest.x;
    after.velocity.rest_y = rest.y;
    after.velocity.rest_z = rest.z;
    return after;
}

// The spin of a body of angular momentum L in this orientation, w = R I^-1 R^T L.
LAW vec3 spin_of(vec4 orientation, vec3 momentum, vec3 inverse_inertia) {
    vec3 l = rotate_back(orientation, momentum);
    return rotate(orientation, vec3(l.x * inverse_inertia.x, l.y * inverse_inertia.y, l.z * inverse_inertia.z));
}

// One substep of free motion. The angular momentum L = R I R^T w is what stays the same while the body turns, so w follows from
// it: once at the middle of the substep (explicit midpoint, second order), once at its end. Torque-free tumbling keeps L to
// rounding, and the energy of a spin lies between L^2 / 2 I_max and L^2 / 2 I_min whatever h. Only the change of w is taken from
// L: its rounding and that of the reciprocals would otherwise add up in one direction, 1e-7 in every substep.
LAW Moved moved(Pose pose, Velocity velocity, Traits traits, float h) {
    Moved after = carried(pose, velocity, h);
    bool tumbles = traits.motion == MOTION_DYNAMIC && !turns_evenly(traits);
    if (none(tumbles)) {
        after.pose.orientation = turned(pose.orientation, velocity.angular, h);
        return after;
    }
    vec3 i = traits.inverse_inertia;
    vec3 spin = rotate_back(pose.orientation, velocity.angular);
    vec3 momentum = rotate(pose.orientation, vec3(spin.x * reciprocal(i.x), spin.y * reciprocal(i.y), spin.z * reciprocal(i.z)));
    vec3 at_first = spin_of(pose.orientation, momentum, i);
    vec4 middle = turned(pose.orientation, velocity.angular, 0.5f * h);
    vec3 halfway = velocity.angular + (spin_of(middle, momentum, i) - at_first);
    after.pose.orientation = turned(pose.orientation, choose(tumbles, halfway, velocity.angular), h);
    vec3 at_last = velocity.angular + (spin_of(after.pose.orientation, momentum, i) - at_first);
    after.velocity.angular = choose(tumbles, at_last, velocity.angular);
    return after;
}

LAWS_END

#endif
