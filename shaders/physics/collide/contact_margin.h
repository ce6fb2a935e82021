// The margin of a pair: how far apart its contact points may be.
#ifndef SCREE_PHYSICS_CONTACT_MARGIN_H
#define SCREE_PHYSICS_CONTACT_MARGIN_H

#include "shaders/physics/body/body_scale.h"
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
};
// Bodies pass each other where their bounding spheres stay further apart than this part of both radii: room for a third body to
// throw one of them towards the other in the step. What is thrown further, the time of impact stops, and it loses a part. (At 50
// diameters a second gases of elastic balls kept 98.6% of their energy for ten seconds, the mean of 64, and with 1/2 98.2.)
CONSTANT float PASSING_ROOM = 0.75f;
// The most by which a body's turning in the step closes a gap, m: its arc, and never more than its bounding sphere.
LAW float closed_by_turning(BodyProperties body, float reach, Velocity v, Parameters parameters) {
    float arc = length3(v.angular) * length3(body.size) * parameters.dt;
    arc = choose(body.shape == SHAPE_PLANE, arc, smaller(arc, reach));
    return choose(body.shape == SHAPE_SPHERE, 0.0f, arc);
}
// `apart`: from A to B.
LAW Margin margin_of(BodyProperties a, Velocity va, BodyProperties b, Velocity vb, vec3 apart, Parameters parameters) {
    float reach_a = bounding_radius(a), reach_b = bounding_radius(b);
    float turning = closed_by_turning(a, reach_a, va, parameters) + closed_by_turning(b, reach_b, vb, parameters);
    float weight = larger(abs(a.gravity_scale), abs(b.gravity_scale)) * (parameters.dt * parameters.dt);
    Margin margin;
    margin.closing = length3(vb.linear - va.linear) * parameters.dt + turning;
    margin.fall = shortened(parameters.gravity * weight, margin.closing);
    margin.least = speculative_of(a, b, parameters);
    // Bodies that pass each other have no contact: each of a cloud of splinters would have one with all others, however fast they
    // are. Should a third body or gravity throw one into another after all, the time of impact stops them.
    vec3 way = (vb.linear - va.linear) * parameters.dt;
    float spheres = reach_a + reach_b, room = PASSING_ROOM * spheres;
    bool may_pass = length3(way) > room && a.shape != SHAPE_PLANE && b.shape != SHAPE_PLANE;
    if (none(may_pass)) return margin;
    room = room + (spheres + margin.least);
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
