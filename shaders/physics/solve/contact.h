// Contacts: how a manifold becomes one, and matching of its points across steps for the warm start.
#ifndef SCREE_PHYSICS_CONTACT_H
#define SCREE_PHYSICS_CONTACT_H

#include "shaders/physics/collide/body_scale.h"
#include "shaders/physics/solve/carried_contact.h"

LAWS_BEGIN

LAW uint feature_of(uint features, uint point) {
    return (features >> (8u * point)) & 0xFFu;
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
    impulse.flight_energy = was.flight_energy;
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

LAWS_END

#endif
