// Time of impact of two bodies by conservative advancement (Mirtich, Impulse-based Dynamic Simulation, PhD thesis,
// Berkeley 1996).
//
// Both advance until the distance between them could be closed at the greatest closing speed; there the distance is
// computed anew. The separation along a fixed axis never exceeds the distance, so only the speed along the axis counts:
// bodies that fly past each other need few rounds.
#ifndef SCREE_PHYSICS_TIME_OF_IMPACT_H
#define SCREE_PHYSICS_TIME_OF_IMPACT_H

#include "shaders/physics/body/motion.h"
#include "shaders/physics/collide/distance.h"
#include "shaders/physics/continuous/clamping.h"

LAWS_BEGIN

// Rounds of advancement. With fewer, bodies that spin beside each other are clamped although they would have passed.
CONSTANT uint IMPACT_ROUNDS = 32u;
// How far a body may penetrate one that was clamped before it, relative to the smaller min_half_width.
CONSTANT float LOST_DEPTH = 0.5f;
// Cosine of the angle (18 degrees) by which a speculative contact's normal may differ from that of the impact.
CONSTANT float SAME_NORMAL = 0.95f;

// A body's motion through the step, linear in position and quaternion, or its part up to where it is clamped.
struct MotionPath {
    vec3 start;   // m
    float until;  // fraction of the step at which it ends
    vec3 way;     // m
    float sweep;  // bound on the surface speed by rotation about an axis perpendicular to the gap, m per step
    vec4 orientation;
    vec4 turn;        // difference of quaternions
    vec3 axis;        // of the rotation, unit
    float most;       // bound on the same for any direction of the gap, m per step
    PoseInBody part;  // pose in the body that moves
    uint of_part;     // 1: it is a part
};
// The part of a shape's turning that moves its surface: those of revolution stand still as they spin about their own axis.
// (Bounded by its spin, a wheel that landed at 9 m/s ran out of rounds, and was clamped where it touched.)
LAW float off_axis(uint shape, vec3 axis, vec4 orientation) {
    return has_straight_side(shape) ? length3(cross3(axis, upright(orientation))) : 1.0f;
}
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
    course.most = course.sweep * off_axis(properties.shape, course.axis, orientation);
    course.part.position = vec3(0.0f);
    course.part.seams = 0u;
    course.part.orientation = vec4(0.0f);
    course.of_part = 0u;
    return course;
}
// The path of a part from that of its body.
LAW MotionPath path_of_part(BodyProperties properties, PoseInBody part, MotionPath body) {
    MotionPath course = body;
    float turning = turning_of(body.orientation, body.turn), lever = lever_of(properties);
    course.sweep = turning * (length3(part.position) + lever);
    float way = length3(cross3(body.axis, rotate(body.orientation, part.position)));
    course.most = turning * (way + lever * off_axis(properties.shape, body.axis, compose(body.orientation, part.orientation)));
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

// Distances of a pair, m.
struct Limits {
    float touch;      // below: in contact; the next step finds it before they overlap
    float slop;       // tolerance
    float depth;      // penetration allowed
    float tolerance;  // of the gap at which they touch
};
// Pairs with a contact in this step were left by the solver, and are clamped only as one is driven half way through the
// other; a narrower limit would stop bodies of a dense flow while the rest runs into them. But once either is clamped,
// the other meets it in a way that the contact did not foresee. Where such a pair touches does not matter, and is not searched
// for: rolling over each other a few millimetres apart, pairs ran out of rounds and were clamped again and again, at a fifth of
// their ways, and what fell behind them went into them (of the deepest in falling heaps two clamps in three were such).
CONSTANT uint NO_CONTACT = 0u;
CONSTANT uint IN_CONTACT = 1u;    // in contact, neither is clamped
CONSTANT uint CONTACT_LOST = 2u;  // in contact, but one of them is clamped
// `joined`: bodies on joints alone would be clamped. Loads of a mechanism press them deep, also into triangles that have no
// contact because their neighbour has, so that only what would go half way through is clamped: a car on a landscape would
// be clamped in every step.
LAW uint contact_state_of(uint contact_points, float stop_a, float stop_b, bool joined) {
    if (joined) return IN_CONTACT;
    if (contact_points == 0u) return NO_CONTACT;
    return stop_a < 1.0f || stop_b < 1.0f ? CONTACT_LOST : IN_CONTACT;
}
// Gap at which bodies are in contact, m: a tenth of the speculative distance of boxes of 1 m, and less for bodies
// thinner than 4 cm.
CONSTANT float TOUCH_PART = 0.1f;
LAW float touch_of(BodyProperties a, BodyProperties b, Parameters parameters) {
    return TOUCH_PART * smaller(parameters.speculative, smaller(min_half_width(a), min_half_width(b)));
}
LAW Limits limits_of(BodyProperties a, BodyProperties b, uint hold, Parameters parameters) {
    float of_a = min_half_width(a), of_b = min_half_width(b);
    float half_way = 0.5f * (of_a + of_b);
    if (a.shape == SHAPE_PLANE || a.shape == SHAPE_TRIANGLE) half_way = 0.5f * of_b;
    if (b.shape == SHAPE_PLANE || b.shape == SHAPE_TRIANGLE) half_way = 0.5f * of_a;
    Limits limits;
    limits.touch = touch_of(a, b, parameters);
    limits.slop = smaller(0.05f * smaller(of_a, of_b), limits.touch);
    limits.depth = limits.slop;
    if (hold == IN_CONTACT) limits.depth = half_way;
    if (hold == CONTACT_LOST) limits.depth = LOST_DEPTH * smaller(of_a, of_b);
    limits.tolerance = 0.1f * limits.touch;
    if (hold != NO_CONTACT) limits.touch = -limits.depth;
    return limits;
}

// Bounding spheres of two bodies on their ways, of which each ends where the body is clamped.
struct Way {
    vec3 start;   // m
    float reach;  // m
    vec3 way;     // m
    float until;  // fraction of the step at which it ends
};
LAW Way way_of(float reach, vec3 start, vec3 end, float until) {
    Way way;
    way.start = start;
    way.reach = reach;
    way.way = end - start;
    way.until = smaller(until, 1.0f);
    return way;
}
// When two points that are `apart` and move on by `way` are within `room` of each other, in parts of that way: none where it ends
// before it begins.
struct Nearing {
    float first;
    float last;
};
LAW Nearing nearing_on(vec3 apart, vec3 way, float room) {
    float per_length = inverse_square_root(larger(dot3(way, way), 1.0e-20f));
    float part = -dot3(apart, way) * (per_length * per_length);
    vec3 nearest = apart + way * part;
    float left = room * room - dot3(nearest, nearest), half_way = square_root(positive(left)) * per_length;
    Nearing near;
    near.first = larger(part - half_way, 0.0f);
    near.last = left < 0.0f ? -1.0f : smaller(part + half_way, 1.0f);
    return near;
}
// The fractions of the step between which the spheres touch. Only there a time of impact is searched for: most of a cloud that
// flies passes, and what spins is far from the others for most of the step.
LAW Nearing nearing_of(Way a, Way b, float touch) {
    float room = 1.001f * (a.reach + b.reach) + 2.0f * touch, both = smaller(a.until, b.until);
    float rest = larger(a.until, b.until) - both;
    vec3 apart = b.start - a.start, together = (b.way - a.way) * both;
    vec3 alone = b.way * (b.until - both) - a.way * (a.until - both);
    Nearing near = nearing_on(apart, together, room), after = nearing_on(apart + together, alone, room);
    bool meets = near.first <= near.last, meets_after = after.first <= after.last;
    near.first = meets ? near.first * both : both + after.first * rest;
    near.last = meets_after ? both + after.last * rest : (meets ? near.last * both : -1.0f);
    return near;
}
LAW bool passes(Nearing near) {
    return near.first > near.last;
}

struct Impact {
    vec3 normal;     // unit, world, from A to B
    float fraction;  // of the step; NO_HIT: none
};
// Time of impact: as the bodies come into contact, if they then overlap. Bodies in contact from the start are clamped
// only where one is driven into the other, and so are those clamped in the previous step as they came into contact:
// clamped there again and again, a hull tipping fast over its edge hung in the air for seconds. Out of rounds, they are
// clamped as far as they are known to be free. `near`: where their spheres touch; `bound`: an impact there or later does not
// matter; `until_touch`: as they come into contact, whatever follows.
LAW Impact impact_of(BodyProperties ta, MotionPath a, BodyProperties tb, MotionPath b, Nearing near, float bound, Limits limits,
                     bool until_touch, Hulls hulls) {
    Impact impact;
    impact.normal = vec3(0.0f);
    impact.fraction = NO_HIT;
    float t = near.first, ends = smaller(larger(a.until, b.until), near.last);
    float aim = limits.touch;
    bool met = false;
    for (uint k = 0u; k < IMPACT_ROUNDS; ++k) {
        if (impact.fraction > 1.0f && t >= bound) return impact;
        bool both = t < a.until && t < b.until;
        float leg = both ? smaller(smaller(a.until, b.until), ends) : ends;
        // A distance that cannot close in this leg need not be exact.
        float fastest = a.most + b.most + length3(both ? b.way - a.way : (t < a.until ? a.way : b.way));
        float enough = aim + (limits.tolerance + limits.slop) + positive(leg - t) * fastest;
        DistanceBound gap = distance_between_shapes(ta, pose_along_path(a, t), tb, pose_along_path(b, t), enough, hulls);
        bool touched = t == 0.0f && gap.distance <= aim + limits.tolerance;
        if (touched) {
            met = true;
            aim = smaller(-limits.depth, gap.distance - limits.slop);
        }
        if (!met && gap.distance <= aim + limits.tolerance) {
            met = true;
            impact.normal = gap.normal;
            impact.fraction = t;
            if (until_touch) return impact;
            aim = -limits.depth;
        }
        if (met && gap.distance <= aim + 0.1f * limits.slop) {
            // Found during the sweep: clamp where contact began. Driven in from the start: clamp here.
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
            if (t >= leg || leg >= ends) {
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

// How far from the centre of its body a row reaches, m; a plane everywhere.
LAW float reach_of(BodyProperties properties) {
    return choose(properties.shape == SHAPE_PLANE, 1.0e15f, bounding_radius(properties));
}

// The pose at the end of the step without contacts.
LAW Pose predict_pose(Pose pose, Velocity velocity, BodyForces load, Parameters parameters) {
    Pose end = pose;
    end.position = pose.position + (velocity.linear + load.acceleration * parameters.dt) * parameters.dt;
    end.orientation = turned(pose.orientation, velocity.angular, parameters.dt);
    return end;
}
// Whether a contact is touching already, not speculative.
LAW bool is_near(Manifold manifold, uint count, BodyProperties a, BodyProperties b, Parameters parameters) {
    bool near = false;
    for (uint k = 0u; k < 4u; ++k)
        if (k < count && manifold.points[k].w <= touch_of(a, b, parameters)) near = true;
    return near;
}
// A speculative contact is doubtful if the predicted sweeps pass each other or meet elsewhere: it would push where
// nothing is.
CONSTANT uint SPECULATIVE = 0x80000000u;  // flag in point_counts: doubtful
// A contact deflects its bodies by more than the prediction's error if they approach faster than this, m/s: 4 mm in a
// step of 1/60 s. At 1 m/s an avalanche lost contacts that it needed and clotted.
CONSTANT float DEFLECTING_SPEED = 0.25f;
LAW bool is_impacting(vec3 normal, Velocity a, Velocity b) {
    return dot3(normal, b.linear - a.linear) < -DEFLECTING_SPEED;
}
// Cosine of the angle between the normals of contact and impact. What a kinematic body drives is pushed along a normal
// that is not quite right, rather than left behind.
LAW float same_normal(bool driven) {
    return driven ? 0.3f : SAME_NORMAL;
}
LAW bool will_meet(vec3 normal, float cosine, BodyProperties ta, Pose a, Velocity va, BodyForces la, BodyProperties tb, Pose b,
                   Velocity vb, BodyForces lb, Parameters parameters, Hulls hulls) {
    Pose end_a = predict_pose(a, va, la, parameters), end_b = predict_pose(b, vb, lb, parameters);
    Nearing near = nearing_of(way_of(reach_of(ta), a.position, end_a.position, 1.0f),
                              way_of(reach_of(tb), b.position, end_b.position, 1.0f), touch_of(ta, tb, parameters));
    if (passes(near)) return false;
    MotionPath ca = path_of(ta, a.position, a.orientation, end_a, 1.0f);
    MotionPath cb = path_of(tb, b.position, b.orientation, end_b, 1.0f);
    Impact impact = impact_of(ta, ca, tb, cb, near, NO_HIT, limits_of(ta, tb, NO_CONTACT, parameters), true, hulls);
    return impact.fraction <= 1.0f && dot3(impact.normal, normal) > cosine;
}

LAWS_END

#endif
