// The constraint of a contact, which the solver reads: anchor body, lever arms, friction patch, materials.
#ifndef SCREE_PHYSICS_CONTACT_CONSTRAINT_H
#define SCREE_PHYSICS_CONTACT_CONSTRAINT_H

#include "shaders/physics/body/body_scale.h"
#include "shaders/physics/constraint/constraint.h"

LAWS_BEGIN

// On three points and more nothing rolls, and the points are those of the smaller face, whichever body is thinner: on a
// thin turntable the contact of a thick box turned about the table, and the box crept inwards by 0.3 mm/s.
LAW uint anchor_of(Contact contact, BodyProperties a, BodyProperties b) {
    bool few = contact.count < 3u;
    float width_a = face_half_width(a, contact.orientation_a, contact.normal);
    float width_b = face_half_width(b, contact.orientation_b, contact.normal);
    bool on_b = (few && stays_with_b(a, b)) || (!few && width_b < width_a);
    bool round = is_round(a) && is_round(b) && contact.count == 1u;
    return choose(round, CONSTRAINT_ROUND, choose(on_b, CONSTRAINT_ON_B, 0u));
}

// Radius of the patch of a single point, of the smaller min_half_width, for torsional friction: with 0, a box pinched
// between two points swings about them for ever.
CONSTANT float POINT_PATCH = 0.01f;

// Mean distance of a patch of uniform pressure from its centre, of that of its contact points (quadrature): an edge's, a
// triangle's, a square's (rectangles of 2:1 and 4:1: 0.53, 0.51) and a disc's, whose points lie on its rim.
CONSTANT float EDGE_SPREAD = 0.5f, TRIANGLE_SPREAD = 0.46f, SQUARE_SPREAD = 0.54f, DISC_SPREAD = 0.6667f;

LAW bool is_rim(BodyProperties properties, float reach) {
    return is_disc(properties) && reach > 0.9f * properties.size.x;
}
// The twist arm of a patch whose points are `reach` from its centre, in the mean, m.
LAW float twist_arm_of(BodyProperties a, BodyProperties b, uint count, float reach) {
    float spread = choose(count == 3u, TRIANGLE_SPREAD, SQUARE_SPREAD);
    spread = choose(is_rim(a, reach) || is_rim(b, reach), DISC_SPREAD, spread);
    spread = choose(count == 2u, EDGE_SPREAD, spread);
    float of_point = choose(rolls(a) || rolls(b), 0.0f, POINT_PATCH * smaller(min_half_width(a), min_half_width(b)));
    return choose(count == 1u, of_point, spread * reach);
}

// Where a point is when it meets, on the surface of the body that keeps it, m from the centre of A. Half way across the gap a
// ball's friction would have a lever arm of more than its radius: balls that met the ground at 7 m/s took up to 25% too much
// spin.
LAW vec3 meeting_point(Contact contact, int k, bool on_b) {
    float half_gap = 0.5f * positive(contact.points[k].w);
    return xyz(contact.points[k]) + contact.normal * choose(on_b, half_gap, -half_gap);
}

// The centre of the friction patch: points that are still apart weigh less, so it moves smoothly as a body tips.
LAW vec3 patch_centre(Contact contact, float speculative, bool on_b) {
    vec3 centre = vec3(0.0f);
    float weights = 0.0f;
    float fade = reciprocal(speculative);
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < contact.count;
        if (none(there)) break;
        float weight = clamped(1.0f - contact.points[k].w * fade, 0.05f, 1.0f);
        vec3 moment = meeting_point(contact, k, on_b) * weight;
        if (k > 0) moment = centre + moment;
        centre = choose(there, moment, centre);
        weights = choose(there, weights + weight, weights);
    }
    return centre * reciprocal(weights);
}

// The slide after which the points of a contact have left the body they slide over, m: half the width of its face. A part
// has none, since its neighbours go on where it ends: thin walls of compounds slid into each other.
LAW float slide_limit_of(Contact contact, BodyProperties ta, BodyProperties tb, uint anchor) {
    bool over_a = anchor == CONSTRAINT_ON_B;
    float width_a = face_half_width(ta, contact.orientation_a, contact.normal);
    float width_b = face_half_width(tb, contact.orientation_b, contact.normal);
    bool endless = anchor == CONSTRAINT_ROUND || (over_a && is_part(ta)) || (!over_a && is_part(tb));
    return choose(endless, 1.0e30f, choose(over_a, width_a, width_b));
}

// The constraint of a contact between inactive bodies, which no pass solves.
LAW Constraint idle_constraint(Contact contact) {
    Constraint c;
    c.a = contact.a;
    c.b = contact.b;
    c.slot_a = NONE;
    c.slot_b = NONE;
    c.normal = contact.normal;
    c.friction = 0.0f;
    c.points_u = vec4(0.0f);
    c.points_v = vec4(0.0f);
    c.drive1 = 0.0f;
    c.drive2 = 0.0f;
    c.static_friction = 0.0f;
    c.restitution_threshold = 0.0f;
    c.centre = vec3(0.0f);
    c.twist_arm = 0.0f;
    c.rolling_resistance = 0.0f;
    c.restitution = 0.0f;
    c.flags = contact.count;
    c.tyre_slip = 0.0f;
    c.radius_a = 0.0f;
    c.radius_b = 0.0f;
    c.links = 0u;
    c.slide_limit = 1.0e30f;
    return c;
}

LAW Constraint constraint_of(Contact contact, BodyProperties ta, BodyProperties tb, uint slot_a, uint slot_b,
                             Parameters parameters) {
    Constraint c = idle_constraint(contact);
    c.slot_a = slot_a;
    c.slot_b = slot_b;
    c.friction = parameters.friction_factor * square_root(ta.friction * tb.friction);
    c.rolling_resistance = larger(ta.rolling_resistance, tb.rolling_resistance);
    c.restitution = larger(parameters.least_restitution, larger(ta.restitution, tb.restitution));
    uint anchor = anchor_of(contact, ta, tb);
    bool on_b = anchor == CONSTRAINT_ON_B, round = anchor == CONSTRAINT_ROUND;
    c.flags = contact.count | anchor;
    c.slide_limit = slide_limit_of(contact, ta, tb, anchor);
    bool single = contact.count == 1u;
    vec3 centre =
        choose(single, meeting_point(contact, 0, on_b), patch_centre(contact, speculative_of(ta, tb, parameters), on_b));
    vec3 u = tangent(contact.normal), v = cross3(contact.normal, u);
    float reach = 0.0f;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < contact.count;
        if (none(there)) break;
        vec3 arm = meeting_point(contact, k, on_b);
        vec3 way = arm - centre;
        c.points_u[k] = choose(there, flush_tiny(dot3(way, u)), 0.0f);
        c.points_v[k] = choose(there, flush_tiny(dot3(way, v)), 0.0f);
        reach = choose(there, reach + length3(way), reach);
    }
    c.twist_arm = twist_arm_of(ta, tb, contact.count, reach * reciprocal(float(contact.count)));
    c.centre = choose(on_b, centre - contact.center_offset, centre);
    if (none(round)) return c;
    c.radius_a = choose(round, ta.size.x, c.radius_a);
    c.radius_b = choose(round, tb.size.x, c.radius_b);
    vec3 half_gap = contact.normal * (0.5f * contact.points[0].w), middle = xyz(contact.points[0]);
    vec3 core_a = middle - half_gap - contact.normal * c.radius_a;
    vec3 core_b = (middle - contact.center_offset) + half_gap + contact.normal * c.radius_b;
    c.points_u = choose(round, vec4(core_a, 0.0f), c.points_u);
    c.centre = choose(round, core_b, c.centre);
    return c;
}

// The constraint of a contact between two bodies; the properties are those of the rows in contact, which may be parts.
LAW Constraint constraint_between(Contact contact, BodyProperties ta, uint body_a, uint slot_a, BodyProperties tb, uint body_b,
                                  uint slot_b, Parameters parameters) {
    Constraint c = constraint_of(contact, ta, tb, slot_a, slot_b, parameters);
    c.a = body_a;
    c.b = body_b;
    return c;
}
// `joints_a`, `joints_b`: of the bodies that the rows belong to.
LAW Constraint with_joints(Constraint c, uint joints_a, uint joints_b) {
    bool held = (c.slot_a != NONE && joints_a != NONE) || (c.slot_b != NONE && joints_b != NONE);
    c.flags = c.flags | choose(held, CONSTRAINT_ON_JOINTS, 0u);
    return c;
}

LAWS_END

#endif
