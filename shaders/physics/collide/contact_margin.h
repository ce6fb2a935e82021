// The margin of a pair: how far apart its contact points may be.
#ifndef SCREE_PHYSICS_CONTACT_MARGIN_H
#define SCREE_PHYSICS_CONTACT_MARGIN_H

#include "shaders/physics/collide/body_scale.h"
#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// Contact margin of a pair along a normal: the most by which velocities can close the gap in the step, plus the
// speculative distance or, if that is more, the fall of a body in the step. A body at rest is held by something and
// does not fall: else each small one would have contacts with all around it, within 2.7 mm at 60 Hz. Speculative
// contacts of fast bodies that will not meet are dropped later (time_of_impact.h).
struct Margin {
    vec3 fall;      // by gravity in the step, at most `closing`, m
    float closing;  // by the velocities, m
    float least;    // speculative distance, m
    float pad0, pad1, pad2;
};
// The part of their way relative to each other by which bodies that pass may be deflected in a step, and still do.
CONSTANT float DEFLECTED_PART = 0.125f;
// Bodies pass where their way is longer than so many of their sizes. (With 1, a gas of elastic balls at 50 diameters a second
// kept 95% of its energy for ten seconds instead of 96: what is deflected is stopped by the time of impact, and loses a part.)
CONSTANT float PASSING_SIZES = 4.0f;
// The most by which a body's turning in the step closes a gap, m: its arc, and never more than its bounding sphere.
LAW float closed_by_turning(BodyProperties body, float reach, Velocity v, Parameters parameters) {
    float arc = length3(v.angular) * length3(body.size) * parameters.dt;
    arc = choose(body.shape == SHAPE_PLANE, arc, smaller(arc, reach));
    return choose(body.shape == SHAPE_SPHERE, 0.0f, arc);
}
// `apart`: from A to B.
LAW Margin margin_of(BodyProperties a, Velocity va, BodyProperties b, Velocity vb, vec3 apart, Parameters parameters) {
    float reach_a = bounding_radius(a.shape, a.size), reach_b = bounding_radius(b.shape, b.size);
    float turning = closed_by_turning(a, reach_a, va, parameters) + closed_by_turning(b, reach_b, vb, parameters);
    float weight = larger(abs(a.gravity_scale), abs(b.gravity_scale)) * (parameters.dt * parameters.dt);
    Margin margin;
    margin.closing = length3(vb.linear - va.linear) * parameters.dt + turning;
    margin.fall = shortened(parameters.gravity * weight, margin.closing);
    margin.least = speculative_of(a, b, parameters);
    margin.pad0 = 0.0f;
    margin.pad1 = 0.0f;
    margin.pad2 = 0.0f;
    // Of bodies whose way relative to each other is much longer than they are, those that pass each other have no contact: each
    // of a cloud of splinters would have one with all others. Should a third body or gravity throw one into another, the time of
    // impact stops them.
    vec3 way = (vb.linear - va.linear) * parameters.dt;
    float length = length3(way);
    bool may_pass = length > PASSING_SIZES * (reach_a + reach_b) && a.shape != SHAPE_PLANE && b.shape != SHAPE_PLANE;
    if (none(may_pass)) return margin;
    float room = (reach_a + reach_b) + (DEFLECTED_PART * length + margin.least);
    bool passes = may_pass && nearest_squared(apart, way) > room * room;
    margin.closing = choose(passes, -1.0e30f, margin.closing);
    return margin;
}
// For every normal.
LAW float greatest_margin(Margin margin) {
    return margin.closing + larger(margin.least, length3(margin.fall));
}

// Drops a manifold found with the greatest margin if that of its normal is less: bodies side by side, which do not fall
// upon each other.
LAW ManifoldBuffer within_margin(ManifoldBuffer touch, Margin margin) {
    float fall = abs(dot3(touch.manifold.normal, margin.fall));
    return choose(deepest_of(touch) < margin.closing + larger(margin.least, fall), touch, empty_manifold());
}

LAWS_END

#endif
