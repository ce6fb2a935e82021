// When two bodies meet on their ways through a step: conservative advancement.
//
// Both go on until the gap between them, at the speed at which it can close at most, could be gone; there it is measured anew
// (Mirtich, Impulse-based Dynamic Simulation, PhD thesis, Berkeley 1996). The gap along a fixed axis never exceeds the distance,
// so only the speed along the axis counts: what flies past is done with in a few rounds.
#ifndef SCREE_PHYSICS_TIME_OF_IMPACT_H
#define SCREE_PHYSICS_TIME_OF_IMPACT_H

#include "shaders/physics/collide/distance.h"
#include "shaders/physics/extra/sweep.h"
#include "shaders/physics/solve/contact.h"

LAWS_BEGIN

// Rounds of advancement. Fewer, and bodies that spin beside each other are stopped although they would have passed.
CONSTANT uint IMPACT_ROUNDS = 32u;
// Of the thinner one's half width: how far a body may enter another that has been stopped before it.
CONSTANT float LOST_DEPTH = 0.5f;
// Cosine of the angle (18 degrees) by which a contact made ahead may differ from the one that the impact will need.
CONSTANT float SAME_NORMAL = 0.95f;

// A body's straight way through the step, or its part up to where it is stopped.
struct MotionPath {
    vec3 start;   // m
    float until;  // fraction at which it ends
    vec3 way;     // m
    float sweep;  // bound on the speed of its surface by turning, about an axis across the gap, m per step
    vec4 orientation;
    vec4 turn;        // of the quaternion
    vec3 axis;        // of the turn, unit
    float most;       // bound on the same whatever the gap's direction, m per step
    PoseInBody part;  // where it lies in the body whose course this is
    uint of_part;     // 1: it is a part
};
LAW MotionPath path_of(BodyProperties properties, vec3 start, vec4 orientation, Pose end, float until) {
    MotionPath course;
    course.start = start;
    course.until = smaller(until, 1.0f);
    course.way = end.position - start;
    course.orientation = orientation;
    course.turn = turn_between(orientation, end.orientation);
    vec4 step_turn = compose(orientation + course.turn, conjugate(orientation));
    course.axis = unit3(vec3(step_turn.x, step_turn.y, step_turn.z), vec3(0.0f, 1.0f, 0.0f));
    course.sweep = turning_of(orientation, course.turn) * lever_of(properties);
    course.most = course.sweep;
    if (properties.shape == SHAPE_CAPSULE) course.most = course.sweep * length3(cross3(course.axis, upright(orientation)));
    course.part.position = vec3(0.0f);
    course.part.pad0 = 0.0f;
    course.part.orientation = vec4(0.0f);
    course.of_part = 0u;
    return course;
}
// A part's, where that is its body's.
LAW MotionPath path_of_part(BodyProperties properties, PoseInBody part, MotionPath body) {
    MotionPath course = body;
    course.sweep = turning_of(body.orientation, body.turn) * (length3(part.position) + lever_of(properties));
    course.most = course.sweep;
    course.part = part;
    course.of_part = 1u;
    return course;
}
LAW Pose pose_along_path(MotionPath course, float fraction) {
    Pose pose = pose_along(course.start, course.way, course.orientation, course.turn, smaller(fraction, course.until));
    if (course.of_part != 0u) pose = pose_of_part(course.part, pose);
    return pose;
}
LAW float arc_along(MotionPath course, vec3 normal) {
    return smaller(course.most, course.sweep * length3(cross3(course.axis, normal)));
}

// What gaps of a pair mean, m.
struct Limits {
    float touch;  // so near, they touch: the next step has their contact and finds it before they overlap
    float slop;   // what counts as no change
    float depth;  // how far they may enter each other
    float pad;
};
// Pairs that had a contact in this step are where it has left them, softness and all, and are stopped only as one is driven half
// way through the other; a narrower limit would hold bodies of a dense flow while the rest goes on into them. But once either is
// stopped, the other runs into it in a way that the contact knew nothing of.
CONSTANT uint NO_CONTACT = 0u;    // no contact
CONSTANT uint IN_CONTACT = 1u;    // a contact, and both go their whole ways
CONSTANT uint CONTACT_LOST = 2u;  // a contact, but one of them is stopped
LAW uint contact_state_of(uint contact_points, float stop_a, float stop_b) {
    if (contact_points == 0u) return NO_CONTACT;
    return stop_a < 1.0f || stop_b < 1.0f ? CONTACT_LOST : IN_CONTACT;
}
LAW Limits limits_of(BodyProperties a, BodyProperties b, uint hold, Parameters parameters) {
    float of_a = min_half_width(a), of_b = min_half_width(b);
    float half_way = 0.5f * (of_a + of_b);
    if (a.shape == SHAPE_PLANE || a.shape == SHAPE_TRIANGLE) half_way = 0.5f * of_b;
    if (b.shape == SHAPE_PLANE || b.shape == SHAPE_TRIANGLE) half_way = 0.5f * of_a;
    Limits limits;
    limits.touch = 0.1f * parameters.speculative;
    limits.slop = smaller(0.05f * smaller(of_a, of_b), limits.touch);
    limits.depth = limits.slop;
    if (hold == IN_CONTACT) limits.depth = half_way;
    if (hold == CONTACT_LOST) limits.depth = LOST_DEPTH * smaller(of_a, of_b);
    limits.pad = 0.0f;
    return limits;
}

struct Impact {
    vec3 normal;     // unit, world, from A to B
    float fraction;  // of the step; NO_HIT if they do not meet
};
// Where the two must be stopped: as they come to touch, if they then overlap. Those that touch from the start have contacts, and
// are stopped only where one is driven into the other. That holds for all that the step before has stopped as they came to touch:
// stopped there again and again, a hull that tips fast over its edge hung in the air for seconds. Out of rounds, they are stopped
// as far as they are known to be free. `until_touch`: as they come to touch, whatever follows.
LAW Impact impact_of(BodyProperties ta, MotionPath a, BodyProperties tb, MotionPath b, Limits limits, bool until_touch,
                     Hulls hulls) {
    Impact impact;
    impact.normal = vec3(0.0f);
    impact.fraction = NO_HIT;
    float t = 0.0f;
    float aim = limits.touch;
    float tolerance = 0.1f * limits.touch;
    bool met = false;
    for (uint k = 0u; k < IMPACT_ROUNDS; ++k) {
        bool both = t < a.until && t < b.until;
        float leg = both ? smaller(a.until, b.until) : larger(a.until, b.until);
        // What cannot close in this leg need not be known better.
        float fastest = a.most + b.most + length3(both ? b.way - a.way : (t < a.until ? a.way : b.way));
        float enough = aim + (tolerance + limits.slop) + positive(leg - t) * fastest;
        DistanceBound gap = distance_between_shapes(ta, pose_along_path(a, t), tb, pose_along_path(b, t), enough, hulls);
        bool touched = k == 0u && gap.distance <= aim + tolerance;
        if (touched) {
            met = true;
            aim = smaller(-limits.depth, gap.distance - limits.slop);
        }
        if (!met && gap.distance <= aim + tolerance) {
            met = true;
            impact.normal = gap.normal;
            impact.fraction = t;
            if (until_touch) return impact;
            aim = -limits.depth;
        }
        if (met && gap.distance <= aim + 0.1f * limits.slop) {
            // Found on the way: stop where they came to touch. Driven in from the start: stop here.
            if (impact.fraction > 1.0f) {
                impact.normal = gap.normal;
                impact.fraction = t;
            }
            return impact;
        }
        float closing = arc_along(a, gap.normal) + arc_along(b, gap.normal);
        if (!both && t >= a.until) closing = arc_along(b, gap.normal);
        if (!both && t >= b.until) closing = arc_along(a, gap.normal);
        if (t < a.until) closing = closing + dot3(gap.normal, a.way);
        if (t < b.until) closing = closing - dot3(gap.normal, b.way);
        float room = gap.distance - aim;
        if (t >= leg || closing * (leg - t) <= room) {
            if (t >= leg || leg >= larger(a.until, b.until)) {
                impact.fraction = NO_HIT;
                return impact;
            }
            t = leg;
        } else {
            t = t + room * reciprocal(closing);
        }
        if (!met) impact.normal = gap.normal;
    }
    impact.fraction = t;
    return impact;
}

// Where a body would be after the step if nothing met it.
LAW Pose predict_pose(Pose pose, Velocity velocity, BodyForces load, Parameters parameters) {
    Pose end = pose;
    end.position = pose.position + (velocity.linear + load.acceleration * parameters.dt) * parameters.dt;
    end.orientation = turned(pose.orientation, velocity.angular, parameters.dt);
    return end;
}
// Whether a contact is one of bodies that touch already.
LAW bool is_near(Manifold manifold, uint count, Parameters parameters) {
    bool near = false;
    for (uint k = 0u; k < 4u; ++k)
        if (k < count && manifold.points[k].w <= 0.1f * parameters.speculative) near = true;
    return near;
}
// What becomes of a contact made ahead, while nothing else strikes the two: they meet about as it says; or they pass each other,
// or touch elsewhere, and then it would push where nothing is.
CONSTANT uint SPECULATIVE = 0x80000000u;  // with the number of its points
// Whether a contact will change the course of its bodies by more than foresight may be wrong: at a quarter of the speed at which
// bodies bounce, 4 mm in a step of 1/60 s. At the whole of it, an avalanche lost contacts that it needed and clotted.
LAW bool is_impacting(vec3 normal, Velocity a, Velocity b, Parameters parameters) {
    return dot3(normal, b.linear - a.linear) < -0.25f * parameters.restitution_threshold;
}
LAW bool will_meet(vec3 normal, BodyProperties ta, Pose a, Velocity va, BodyForces la, BodyProperties tb, Pose b, Velocity vb,
                   BodyForces lb, Parameters parameters, Hulls hulls) {
    MotionPath ca = path_of(ta, a.position, a.orientation, predict_pose(a, va, la, parameters), 1.0f);
    MotionPath cb = path_of(tb, b.position, b.orientation, predict_pose(b, vb, lb, parameters), 1.0f);
    Impact impact = impact_of(ta, ca, tb, cb, limits_of(ta, tb, NO_CONTACT, parameters), true, hulls);
    return impact.fraction <= 1.0f && dot3(impact.normal, normal) > SAME_NORMAL;
}

LAWS_END

#endif
