// Contacts: how a manifold becomes one, and matching of its points across steps for the warm start.
#ifndef SCREE_PHYSICS_CONTACT_H
#define SCREE_PHYSICS_CONTACT_H

#include "shaders/physics/body/body_scale.h"
#include "shaders/physics/contact/carried_contact.h"

LAWS_BEGIN

LAW uint feature_of(uint features, int point) {
    return (features >> (8 * point)) & 0xFFu;
}
LAW vec4 separations_of(Contact contact) {
    return vec4(contact.points[0].w, contact.points[1].w, contact.points[2].w, contact.points[3].w);
}

// How far a point may move on a body between steps and still match, m. Patches of three points or more keep nearly all, so that
// they keep their warm start when other corners are chosen.
CONSTANT float MATCHED = 0.1f;        // of the smaller min_half_width
CONSTANT float FACE_MATCHED = 0.5f;   // of the smaller width along the contact plane, between boxes and planes
CONSTANT float PATCH_MATCHED = 1.5f;  // of the same if one has many corners
LAW float match_radius(Contact now, Contact before, BodyProperties a, BodyProperties b) {
    bool few = now.count < 3u || before.count < 3u;
    float narrow = MATCHED * smaller(min_half_width(a), min_half_width(b));
    if (none(!few)) return narrow;
    float width = smaller(face_half_width(a, now.orientation_a, now.normal), face_half_width(b, now.orientation_b, now.normal));
    bool has_corners = is_general_convex(a.shape) || is_general_convex(b.shape);
    return choose(few, narrow, choose(has_corners, PATCH_MATCHED, FACE_MATCHED) * width);
}

// For each new point the index of the matching old point, or NONE: the nearest unmatched one within `radius`, measured
// in A's frame; feature ids only break ties, because they flicker while points stay. A single point matches a single
// point at any distance: a wheel's contact travels round the wheel.
LAW uvec4 matches_of(Contact now, Contact before, float radius) {
    uvec4 matches = uvec4(NONE);
    bool single = now.count == 1u && before.count == 1u;
    vec4 old[4];
    for (int j = 0; j < 4; ++j) old[j] = vec4(rotate_back(before.orientation_a, xyz(before.points[j])), 0.0f);
    uint taken = 0u;
    for (int k = 0; k < 4; ++k) {
        bool there = !single && uint(k) < now.count;
        if (!none(there)) {
            vec3 anchor = rotate_back(now.orientation_a, xyz(now.points[k]));
            float nearest = radius * radius;
            uint match = NONE, bit = 0u;
            for (int j = 0; j < 4; ++j) {
                vec3 apart = anchor - xyz(old[j]);
                float score = dot3(apart, apart);
                bool renamed = feature_of(now.features, k) != feature_of(before.features, j);
                score = choose(renamed, score + 4.0e-6f * (radius * radius), score);
                bool closer = there && uint(j) < before.count && score < nearest && (taken & (1u << j)) == 0u;
                nearest = choose(closer, score, nearest);
                match = choose(closer, uint(j), match);
                bit = choose(closer, uint(1u << j), bit);
            }
            matches[k] = match;
            taken = taken | bit;
        }
    }
    matches.x = choose(single, 0u, matches.x);
    return matches;
}

// Whether an impact of the last step has energy left to return in this one.
LAW bool rebounds_across(ContactImpact was) {
    return was.impact_energy > 0.0f;
}

LAW float component(vec4 v, uint k) {
    return choose(k == 0u, v.x, choose(k == 1u, v.y, choose(k == 2u, v.z, v.w)));
}
// Whether a contact of one point inherits its twist: that of an edge or a face it could not take back, and without a material
// it has hardly any.
LAW bool keeps_twist(Contact before, BodyProperties a, BodyProperties b) {
    return before.count == 1u && ((a.flags | b.flags) >> ROW_SURFACE_SHIFT) != 0u;
}
// Impulses of the matching points; friction only if some normal impulse is left, projected onto the new tangent plane.
LAW Impulse warm_start_from(Contact now, Impulse was, uvec4 matches, bool point_twists) {
    Impulse impulse = no_impulse(now.center_offset);
    for (int k = 0; k < 4; ++k) {
        bool matched = matches[k] != NONE;
        impulse.normal[k] = choose(matched, component(was.normal, matches[k]), 0.0f);
        impulse.impact[k] = choose(matched, component(was.impact, matches[k]), 0.0f);
    }
    impulse.rebound_energy = was.rebound_energy;
    impulse.impact_energy = was.impact_energy;
    impulse.speed_before_push = was.speed_before_push;
    bool bears = (impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w) > 0.0f;
    bool twists = bears && (now.count > 1u || point_twists);
    impulse.friction = choose(bears, flush_tiny(was.friction - now.normal * dot3(was.friction, now.normal)), impulse.friction);
    impulse.stretch = choose(bears, flush_tiny(was.stretch - now.normal * dot3(was.stretch, now.normal)), impulse.stretch);
    impulse.rolling = choose(bears, was.rolling, impulse.rolling);
    impulse.twist = choose(twists, was.twist, 0.0f);
    impulse.turn = choose(twists, was.turn, 0.0f);
    return impulse;
}

LAW Contact contact_of(Pair pair, Manifold manifold, uint count, Pose a, Pose b) {
    Contact contact;
    contact.a = pair.a;
    contact.b = pair.b;
    contact.count = count;
    contact.features = manifold.features;
    contact.normal = manifold.normal;
    contact.pad0 = 0.0f;
    contact.center_offset = b.position - a.position;
    contact.load = 0.0f;
    for (int k = 0; k < 4; ++k) contact.points[k] = manifold.points[k];
    contact.orientation_a = a.orientation;
    contact.orientation_b = b.orientation;
    return contact;
}

LAWS_END

#endif
