// Persistent manifolds: while two bodies hardly move relative to each other, their contact keeps its geometry.
//
// After Box3D's contact recycling (Erin Catto): normal, points, impulses and lever arms are those of the step in which
// the contact was made, and only the separation is updated, from body-fixed anchors. Frozen lever arms prevent the
// sideways shift of the load that makes a column of soft contacts buckle, and what is equal in every step can come to
// rest. The price: the two forces of a contact act up to the tolerance apart, so the angular momentum of a resting pair
// is exact only to that. The tolerance is therefore small against the bodies: sliding, rolling and tipping end
// persistence at once. Without gravity nothing stands or leans and no contact persists, so angular momentum there is
// exact to rounding.
#ifndef SCREE_PHYSICS_PERSISTENCE_H
#define SCREE_PHYSICS_PERSISTENCE_H

#include "shaders/physics/base/contact_impulse.h"
#include "shaders/physics/body/body_scale.h"

LAWS_BEGIN

// Slip is measured along the contact plane, relative to the smaller width there. Compression does not count: the sag of
// a column depends on gravity and the substep, not on size, and exceeds 1% of the thickness of coins and of boxes of 2
// cm, which fell.
CONSTANT float KEPT_SLIP = 0.01f;     // anchors further apart end persistence
CONSTANT float KEPT_SPEED = 0.1f;     // per second: faster is sliding, rolling or tipping
CONSTANT float KEPT_TURN = 0.99905f;  // cosine of half the rotation (5 degrees) of a body that ends persistence
// Sine of half the rotation of a body about the normal that does (1 degree): the frozen offset of the centres lags behind,
// and with 5 degrees what stood askew on a turntable crept outwards, ever faster.
CONSTANT float KEPT_YAW = 0.00873f;
// The limit of any rotation for one or two points (0.6 degrees, about what the slip tolerance allows with more): a body rocks
// about them without slip, and while the normal of two edges is frozen and they turn, the rocking never ends.
CONSTANT float KEPT_ROCKING = 0.9999875f;

// A body that tips over two of its four points falls upon a corner that manifold reduction left out and rebounds:
// columns rocked on for ever. So persistence ends when B rotates relative to A faster than this (squared: 0.05 rad/s for
// boxes of 1 m; with 0.1, four heaps of 50 never came to rest), or has rotated this far (sine of half the
// angle, squared: 0.4 degrees there). With less, columns hop between two choices of four points that shift them by more
// than that; with degrees, a corner falls 17 mm deep. (Preferring the corners chosen before brought no more heaps to
// rest.) Both limits go with the inverse root of the size (Froude): what is small rotates faster under gravity, and
// with one limit for all sizes ten boxes of 1 cm fell.
CONSTANT float KEPT_SPIN_SQUARED = 0.00125f;   // (rad/s)^2 m
CONSTANT float KEPT_TILT_SQUARED = 6.125e-6f;  // m

// From the anchor of a point on A to its anchor on B at the present poses, world, m.
LAW vec3 gap_between_marks(Contact contact, int point, Pose a, Pose b) {
    vec3 arm = xyz(contact.points[point]);
    vec3 half_gap = contact.normal * (0.5f * contact.points[point].w);
    vec3 mark_a = rotate(a.orientation, rotate_back(contact.orientation_a, arm - half_gap));
    vec3 mark_b = rotate(b.orientation, rotate_back(contact.orientation_b, (arm - contact.center_offset) + half_gap));
    return (b.position - a.position) + mark_b - mark_a;
}

// cos| of half the angle between two orientations.
LAW float cosine_between(vec4 before, vec4 now) {
    return abs((before.x * now.x + before.y * now.y) + (before.z * now.z + before.w * now.w));
}
// The rotation from `before` to `now` as a quaternion.
LAW vec4 turn_since(vec4 before, vec4 now) {
    vec3 from = vec3(before.x, before.y, before.z), to = vec3(now.x, now.y, now.z);
    vec3 turn = (to * before.w - from * now.w) - cross3(to, from);
    return vec4(turn, now.w * before.w + dot3(to, from));
}
LAW bool turned_little(vec4 before, vec4 now, uint points) {
    return cosine_between(before, now) > choose(points > 2u, KEPT_TURN, KEPT_ROCKING);
}

// Whether a contact of two shapes may persist at all: it bore an impulse, and neither body can roll on the other.
LAW bool may_persist(Impulse impulse, uint shape_a, uint shape_b) {
    return (impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w) > 0.0f &&
           !(touches_in_a_point(shape_a) || touches_in_a_point(shape_b) || (has_round_core(shape_a) && has_round_core(shape_b)));
}
// Whether last step's contact, which may, persists: rotations are below the limits, and the anchors neither separate nor
// slide.
LAW bool is_persistent(Contact contact, BodyProperties ta, Pose a, Velocity va, BodyProperties tb, Pose b, Velocity vb) {
    bool keeps = turned_little(contact.orientation_a, a.orientation, contact.count) &&
                 turned_little(contact.orientation_b, b.orientation, contact.count);
    vec4 since_a = turn_since(contact.orientation_a, a.orientation), since_b = turn_since(contact.orientation_b, b.orientation);
    keeps = keeps && abs(dot3(xyz(since_a), contact.normal)) <= KEPT_YAW && abs(dot3(xyz(since_b), contact.normal)) <= KEPT_YAW;
    // The frozen offset of the centres lags behind a kinematic body that turns: what lies on it would creep.
    keeps = keeps && !(motion_of(ta) == MOTION_KINEMATIC && dot3(va.angular, va.angular) > 0.0f) &&
            !(motion_of(tb) == MOTION_KINEMATIC && dot3(vb.angular, vb.angular) > 0.0f);
    if (none(keeps)) return keeps;
    vec3 tilt = xyz(since_a) - xyz(since_b);
    vec3 spin = vb.angular - va.angular;
    float size = smaller(face_half_width(ta, a.orientation, contact.normal), face_half_width(tb, b.orientation, contact.normal));
    keeps = keeps && dot3(tilt, tilt) * size <= KEPT_TILT_SQUARED && dot3(spin, spin) * size <= KEPT_SPIN_SQUARED;
    float tolerance = KEPT_SLIP * size;
    float fastest = KEPT_SPEED * size;
    for (int k = 0; k < 4; ++k) {
        bool there = keeps && uint(k) < contact.count;
        if (none(there)) break;
        vec3 slip = gap_between_marks(contact, k, a, b) - contact.normal * contact.points[k].w;
        slip = slip - contact.normal * dot3(slip, contact.normal);
        vec3 arm = xyz(contact.points[k]);
        vec3 speed = (vb.linear + cross3(vb.angular, arm - contact.center_offset)) - (va.linear + cross3(va.angular, arm));
        speed = speed - contact.normal * dot3(speed, contact.normal);
        bool slides = dot3(slip, slip) > tolerance * tolerance || dot3(speed, speed) > fastest * fastest;
        keeps = keeps && !(there && slides);
    }
    return keeps;
}

// The contact's manifold with its separations updated from the anchors.
LAW Manifold persistent_manifold(Contact contact, Pose a, Pose b) {
    Manifold manifold;
    manifold.normal = contact.normal;
    manifold.features = contact.features;
    for (int k = 0; k < 4; ++k) {
        bool there = uint(k) < contact.count;
        manifold.points[k] = vec4(0.0f);
        if (none(there)) continue;
        float separation = dot3(contact.normal, gap_between_marks(contact, k, a, b));
        manifold.points[k] = choose(there, vec4(xyz(contact.points[k]), separation), manifold.points[k]);
    }
    return manifold;
}

// The manifold of two inactive bodies, unchanged.
LAW Manifold resting_manifold(Contact contact, Impulse impulse) {
    Manifold manifold;
    manifold.normal = contact.normal;
    manifold.features = contact.features;
    for (int k = 0; k < 4; ++k)
        manifold.points[k] = choose(uint(k) < contact.count, vec4(xyz(contact.points[k]), impulse.separation[k]), vec4(0.0f));
    return manifold;
}

LAWS_END

#endif
