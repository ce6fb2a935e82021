// The way of a body through one step: whether it is so long that something could be passed unseen, and where it ends early.
//
// A body is fast if it moves by more than half of its thickness in a step. What is slower cannot pass anything whole: it enters
// it by that much at most, and its contact pushes it back out of the side where it came in. Fast bodies are looked after three
// times: contacts are made ahead only for those that will meet (shaders/stages/foresee_impacts.comp), after the last substep they
// are stopped where their ways meet (find_impacts.comp), or where they leave the bounds in which their neighbours were searched.
// A stopped body keeps its velocity and goes on in the next step, which finds its contact (the way of Box2D and Box3D, Erin
// Catto, Continuous Collision, GDC 2013).
#ifndef SCREE_PHYSICS_FLIGHT_H
#define SCREE_PHYSICS_FLIGHT_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

// Fraction of a step at which a body is stopped that is not: more than 1, so that it is told from those that may be.
CONSTANT float NEVER = 2.0f;

// Rounds of search for what must stop. The first finds who meets whom, the second who runs into those that the first has stopped,
// and so on: with fewer, bodies that fly in a row pass each other when the first of them is stopped.
CONSTANT uint FLIGHT_ROUNDS = 3u;

LAW float thickness(Traits traits) {
    return min_half_width(traits.shape, traits.size);
}
LAW float farthest_of(Traits traits) {
    return bounding_radius(traits.shape, traits.size);
}
LAW float lever_of(Traits traits) {
    return turning_reach(traits.shape, traits.size);
}

// How far a body may go in a step unwatched, m. A larger part, and a thin plate could be entered beyond its middle.
LAW float unwatched_way(Traits traits) {
    return 0.5f * thickness(traits);
}
LAW bool in_motion(Velocity v) {
    return v.linear.x != 0.0f || v.linear.y != 0.0f || v.linear.z != 0.0f || v.angular.x != 0.0f || v.angular.y != 0.0f ||
           v.angular.z != 0.0f;
}
// Whether a body at this velocity will be fast. What hangs on a joint never is: to stop it alone would tear it out of its joint
// (limbs of figures that fall were 0.5 m apart), and the contacts that are made ahead of its way hold it back.
LAW bool will_be_fast(Traits traits, Velocity velocity, Parameters parameters) {
    if (!in_motion(velocity) || traits.joints != NONE) return false;
    float way = length3(velocity.linear) + length3(velocity.angular) * lever_of(traits);
    return traits.motion != MOTION_FIXED && way * parameters.dt > unwatched_way(traits);
}

LAW vec3 half_extents_of(Traits traits, vec4 orientation) {
    return world_half_extents(traits.shape, traits.size, orientation);
}

// From one orientation to another on the shorter way: the difference of the quaternions, whichever sign the second has.
LAW vec4 turn_between(vec4 from, vec4 to) {
    float cosine = (from.x * to.x + from.y * to.y) + (from.z * to.z + from.w * to.w);
    return cosine < 0.0f ? -to - from : to - from;
}
// A bound on how fast a body turns if its quaternion goes straight from one orientation by `turn` to the other, rad per step: the
// quaternion's angle p (half of the turn) passes fastest midway, at twice the tangent of half of p: 2 |turn| over |from + to|.
LAW float turning_of(vec4 from, vec4 turn) {
    vec4 both = from * 2.0f + turn;
    float chord = (turn.x * turn.x + turn.y * turn.y) + (turn.z * turn.z + turn.w * turn.w);
    float sum = (both.x * both.x + both.y * both.y) + (both.z * both.z + both.w * both.w);
    return 4.0f * square_root(chord) * inverse_square_root(sum);
}

LAW Flight flight_of(Pose pose) {
    Flight flight;
    flight.position = pose.position;
    flight.pad0 = 0.0f;
    flight.orientation = pose.orientation;
    flight.stops[0] = floatBitsToUint(NEVER);
    flight.stops[1] = floatBitsToUint(NEVER);
    flight.struck = 0u;
    flight.pad1 = 0u;
    return flight;
}
LAW Flight stopped_at(Flight flight, float fraction) {
    flight.stops[0] = floatBitsToUint(fraction);
    flight.stops[1] = floatBitsToUint(fraction);
    return flight;
}
LAW float stop_of(Flight flight) {
    return smaller(uintBitsToFloat(flight.stops[0]), uintBitsToFloat(flight.stops[1]));
}

LAW bool was_fast(Traits traits, Flight flight, Pose end) {
    vec4 turn = turn_between(flight.orientation, end.orientation);
    float way = length3(end.position - flight.position) + turning_of(flight.orientation, turn) * lever_of(traits);
    return way > unwatched_way(traits) && traits.joints == NONE;
}

// The fraction of a way along one axis, from 0 to `way`, that lies between -back and ahead (both may be negative: then none).
LAW float part_within(float way, float back, float ahead) {
    float room = way > 0.0f ? ahead : back;
    float length = abs(way);
    if (length <= room) return 1.0f;
    return room > 1.0e-9f ? room * reciprocal(length) : 0.0f;
}
// The fraction of its way after which a body leaves the bounds in which its neighbours were searched, by more than what it may go
// unwatched; 1 if it stays within. What a ricochet or a blow sends elsewhere would else pass bodies that nobody has paired with
// it.
LAW float seen_part(Traits traits, Flight flight, Pose end, Bounds bounds) {
    vec3 half_size = larger3(half_extents_of(traits, flight.orientation), half_extents_of(traits, end.orientation));
    half_size = half_size - vec3(unwatched_way(traits));
    vec3 back = (flight.position - half_size) - bounds.lower;
    vec3 ahead = bounds.upper - (flight.position + half_size);
    vec3 way = end.position - flight.position;
    float part = part_within(way.x, back.x, ahead.x);
    part = smaller(part, part_within(way.y, back.y, ahead.y));
    return smaller(part, part_within(way.z, back.z, ahead.z));
}

LAW Pose pose_along(vec3 position, vec3 way, vec4 orientation, vec4 turn, float fraction) {
    Pose pose;
    pose.position = position + way * fraction;
    pose.rest_x = 0.0f;
    pose.orientation = unit_quaternion(orientation + turn * fraction);
    return pose;
}

struct Halted {
    Pose pose;
    Velocity velocity;
};
// The body where it is stopped. Its velocity stays, but for what gravity and forces have done on the rest of its way, which is
// still before it: v^2 - 2 a.x, so that waiting costs and gains no energy.
LAW Halted halted(Flight flight, Pose end, Velocity velocity, Load load, float fraction) {
    Halted after;
    after.pose = pose_along(flight.position, end.position - flight.position, flight.orientation,
                            turn_between(flight.orientation, end.orientation), fraction);
    after.velocity = velocity;
    after.velocity.rest_y = 0.0f;
    after.velocity.rest_z = 0.0f;
    float work = 2.0f * dot3(load.acceleration, end.position - after.pose.position);
    float squared = dot3(velocity.linear, velocity.linear);
    if (abs(work) > 1.0e-6f * squared && abs(work) < 0.5f * squared)
        after.velocity.linear = velocity.linear * square_root((squared - work) * reciprocal(squared));
    return after;
}

LAWS_END

#endif
