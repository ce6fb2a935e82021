// Contacts: matching points across steps for the warm start, and the constraint that the solver reads.
#ifndef SCREE_PHYSICS_CONTACT_H
#define SCREE_PHYSICS_CONTACT_H

#include "shaders/physics/collide/compound.h"
#include "shaders/physics/collide/rolling_contact.h"
#include "shaders/physics/extra/sweep.h"
#include "shaders/physics/solve/constraint.h"
#include "shaders/physics/solve/motion.h"

LAWS_BEGIN

LAW uint feature_of(uint features, uint point) {
    return (features >> (8u * point)) & 0xFFu;
}

// Half width of a box or cylinder whose half extents or radii are `size` along the plane with that normal, m.
LAW float width_across(vec3 size, vec4 orientation, vec3 normal) {
    vec3 slant = absolute3(rotate_back(orientation, normal));
    if (slant.x >= slant.y && slant.x >= slant.z) return smaller(size.y, size.z);
    return slant.y >= slant.z ? smaller(size.x, size.z) : smaller(size.x, size.y);
}
// Half width of the body along the contact plane, m: a point that slides further has left its face.
LAW float width_along(BodyProperties properties, vec4 orientation, vec3 normal) {
    if (properties.shape != SHAPE_BOX || is_part(properties)) return min_half_width(properties);
    return width_across(properties.size, orientation, normal);
}
// The same for flat faces of every shape, the scale of what a patch may slip: a coin's is its radius, not its thickness.
LAW float patch_width(BodyProperties properties, vec4 orientation, vec3 normal) {
    bool axial = properties.shape == SHAPE_CYLINDER || properties.shape == SHAPE_CONE;
    if ((!axial && properties.shape != SHAPE_HULL) || is_part(properties)) return width_along(properties, orientation, normal);
    vec3 size = axial ? vec3(properties.size.x, properties.size.y, properties.size.x) : properties.size * 0.5f;
    return width_across(size, orientation, normal);
}

// How far a point may move on a body between steps and still match, m. Patches of three points or more keep nearly all:
// with MATCHED for them too, stacks of coins and prisms lost their warm start each time other corners were chosen and
// rocked for ever, and boxes of 1 cm fell. (With PATCH_MATCHED for boxes as well a heap of 150 was not at rest within 8 s.)
CONSTANT float MATCHED = 0.1f;        // of the smaller min_half_width
CONSTANT float FACE_MATCHED = 0.5f;   // of the smaller width along the contact plane, between boxes and planes
CONSTANT float PATCH_MATCHED = 1.5f;  // of the same if one has many corners
LAW float match_radius(Contact now, Contact before, BodyProperties a, BodyProperties b) {
    if (now.count < 3u || before.count < 3u) return MATCHED * smaller(min_half_width(a), min_half_width(b));
    float width = smaller(patch_width(a, now.orientation_a, now.normal), patch_width(b, now.orientation_b, now.normal));
    return (is_general_convex(a.shape) || is_general_convex(b.shape) ? PATCH_MATCHED : FACE_MATCHED) * width;
}

LAW Impulse no_impulse(vec3 d) {
    Impulse impulse;
    impulse.normal = vec4(0.0f);
    impulse.solved_normal = vec4(0.0f);
    impulse.separation = vec4(0.0f);
    impulse.impact = vec4(0.0f);
    impulse.rebound_energy = 0.0f;
    impulse.impact_energy = 0.0f;
    impulse.impact_weight = 0.0f;
    impulse.flight_energy = 0.0f;
    impulse.friction = vec3(0.0f);
    impulse.twist = 0.0f;
    impulse.rolling = vec3(0.0f);
    impulse.slide_distance = 0.0f;
    impulse.center_offset = d;
    impulse.normal_sum = 0.0f;
    impulse.stretch = vec3(0.0f);
    impulse.turn = 0.0f;
    return impulse;
}

// For each new point the index of the matching old point, or NONE: the nearest unmatched one within `radius`, measured
// in A's frame; feature ids only break ties, because they flicker while points stay. A single point matches a single
// point at any distance: a wheel's contact travels round the wheel.
LAW uvec4 matches_of(Contact now, Contact before, float radius) {
    uvec4 matches = uvec4(NONE);
    if (now.count == 1u && before.count == 1u) {
        matches.x = 0u;
        return matches;
    }
    uint taken = 0u;
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= now.count) break;
        vec3 anchor = rotate_back(now.orientation_a, xyz(now.points[k]));
        float nearest = radius * radius;
        for (uint j = 0u; j < 4u; ++j) {
            if (j >= before.count) break;
            vec3 apart = anchor - rotate_back(before.orientation_a, xyz(before.points[j]));
            float score = dot3(apart, apart);
            if (feature_of(now.features, k) != feature_of(before.features, j)) score = score + 4.0e-6f * (radius * radius);
            if (score < nearest && ((taken >> j) & 1u) == 0u) {
                nearest = score;
                matches[k] = j;
            }
        }
        if (matches[k] != NONE) taken = taken | (1u << matches[k]);
    }
    return matches;
}

// Whether an impact of the last step has energy left to return in this one.
LAW bool rebounds_across(Impulse was) {
    return was.impact_energy > 0.0f;
}

// Impulses of the matching points; friction only if some normal impulse is left, projected onto the new tangent plane.
LAW Impulse warm_start_from(Contact now, Impulse was, uvec4 matches) {
    Impulse impulse = no_impulse(now.center_offset);
    for (uint k = 0u; k < 4u; ++k) {
        if (matches[k] == NONE) continue;
        impulse.normal[k] = was.normal[matches[k]];
        impulse.solved_normal[k] = was.solved_normal[matches[k]];
        impulse.impact[k] = was.impact[matches[k]];
    }
    impulse.rebound_energy = was.rebound_energy;
    impulse.impact_energy = was.impact_energy;
    float total = (impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w);
    if (total > 0.0f) {
        impulse.friction = was.friction - now.normal * dot3(was.friction, now.normal);
        // A single point has no torsional friction that would reduce an inherited twist.
        if (now.count > 1u) {
            impulse.twist = was.twist;
            impulse.turn = was.turn;
        }
        impulse.stretch = was.stretch - now.normal * dot3(was.stretch, now.normal);
        impulse.rolling = was.rolling;
    }
    return impulse;
}

LAW Contact contact_of(Pair pair, Manifold manifold, uint count, Pose a, Pose b) {
    Contact contact;
    contact.a = pair.a;
    contact.b = pair.b;
    contact.count = count;
    contact.features = manifold.features;
    contact.normal = manifold.normal;
    contact.unrest = 0.0f;
    contact.center_offset = b.position - a.position;
    contact.load = 0.0f;
    for (uint k = 0u; k < 4u; ++k) contact.points[k] = manifold.points[k];
    contact.orientation_a = a.orientation;
    contact.orientation_b = b.orientation;
    return contact;
}

LAW vec4 separations_of(Manifold manifold) {
    return vec4(manifold.points[0].w, manifold.points[1].w, manifold.points[2].w, manifold.points[3].w);
}

// Round bodies: in the contact of two, point and normal follow both; other points stay with one body
// (rolling_contact.h).
LAW bool is_round(BodyProperties properties) {
    return has_round_core(properties.shape);
}
LAW bool rolls(BodyProperties properties) {
    return can_roll(properties.shape);
}
// The same where the bodies touch in `points` points: with three and more a disc lies flat.
LAW float face_half_width(BodyProperties properties, vec4 orientation, vec3 normal, uint points) {
    bool disc = (properties.shape == SHAPE_CYLINDER || properties.shape == SHAPE_CONE) && !is_part(properties);
    return disc && points > 2u ? properties.size.x : width_along(properties, orientation, normal);
}
// On three points and more nothing rolls, and the points are those of the smaller face, whichever body is thinner: on a
// thin turntable the contact of a thick box turned about the table, and the box crept inwards by 0.3 mm/s.
LAW uint anchor_of(Contact contact, BodyProperties a, BodyProperties b) {
    if (is_round(a) && is_round(b) && contact.count == 1u) return CONSTRAINT_ROUND;
    if (contact.count < 3u) return stays_with_b(a, b) ? CONSTRAINT_ON_B : 0u;
    float width_a = face_half_width(a, contact.orientation_a, contact.normal, contact.count);
    float width_b = face_half_width(b, contact.orientation_b, contact.normal, contact.count);
    return width_b < width_a ? CONSTRAINT_ON_B : 0u;
}

// Radius of the patch of a single point, of the smaller min_half_width, for torsional friction: with 0, a box pinched
// between two points swings about them for ever.
CONSTANT float POINT_PATCH = 0.01f;

// Mean distance of a patch of uniform pressure from its centre, of that of its contact points (quadrature): an edge's, a
// triangle's, a square's (rectangles of 2:1 and 4:1: 0.53, 0.51) and a disc's, whose points lie on its rim.
CONSTANT float EDGE_SPREAD = 0.5f, TRIANGLE_SPREAD = 0.46f, SQUARE_SPREAD = 0.54f, DISC_SPREAD = 0.6667f;

LAW bool is_rim(BodyProperties properties, float reach) {
    return (properties.shape == SHAPE_CYLINDER || properties.shape == SHAPE_CONE) && reach > 0.9f * properties.size.x;
}
// The twist arm of a patch whose points are `reach` from its centre, in the mean, m.
LAW float twist_arm_of(BodyProperties a, BodyProperties b, uint count, float reach) {
    if (count == 1u) return rolls(a) || rolls(b) ? 0.0f : POINT_PATCH * smaller(min_half_width(a), min_half_width(b));
    if (count == 2u) return EDGE_SPREAD * reach;
    if (is_rim(a, reach) || is_rim(b, reach)) return DISC_SPREAD * reach;
    return (count == 3u ? TRIANGLE_SPREAD : SQUARE_SPREAD) * reach;
}

// The centre of the friction patch: points that are still apart weigh less, so it moves smoothly as a body tips.
LAW vec3 patch_centre(Contact contact, float speculative) {
    vec3 centre;
    float weights = 0.0f;
    float fade = reciprocal(speculative);
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= contact.count) break;
        float weight = clamped(1.0f - contact.points[k].w * fade, 0.05f, 1.0f);
        vec3 moment = xyz(contact.points[k]) * weight;
        centre = k == 0u ? moment : centre + moment;
        weights = weights + weight;
    }
    return centre * reciprocal(weights);
}

// The constraint of a contact between inactive bodies, read by statistics alone.
LAW Constraint idle_constraint(Contact contact) {
    Constraint c;
    c.a = contact.a;
    c.b = contact.b;
    c.slot_a = NONE;
    c.slot_b = NONE;
    c.normal = contact.normal;
    c.friction = 0.0f;
    c.arms_x = vec4(0.0f);
    c.arms_y = vec4(0.0f);
    c.arms_z = vec4(0.0f);
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
    c.pair = NONE;
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
    if (on_b) c.slide_limit = face_half_width(ta, contact.orientation_a, contact.normal, contact.count);
    if (!on_b && !round) c.slide_limit = face_half_width(tb, contact.orientation_b, contact.normal, contact.count);
    vec3 centre = patch_centre(contact, speculative_of(ta, tb, parameters));
    float reach = 0.0f;
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= contact.count) break;
        vec3 arm = xyz(contact.points[k]);
        c = with_lever_arm(c, int(k), on_b ? arm - contact.center_offset : arm);
        reach = reach + length3(arm - centre);
    }
    c.twist_arm = twist_arm_of(ta, tb, contact.count, reach * reciprocal(float(contact.count)));
    c.centre = on_b ? centre - contact.center_offset : centre;
    if (round) {
        c.radius_a = ta.size.x;
        c.radius_b = tb.size.x;
        vec3 half_gap = contact.normal * (0.5f * contact.points[0].w);
        c = with_lever_arm(c, 0, centre - half_gap - contact.normal * c.radius_a);
        c.centre = (centre - contact.center_offset) + half_gap + contact.normal * c.radius_b;
    }
    return c;
}

LAWS_END

#endif
