// Contacts that are kept: while two bodies hardly move against each other, their contact stays as it was made.
//
// The idea is Box3D's (Erin Catto, contact recycling): normal, points, impulses and lever arms are those of the step in which the
// contact was made, and only the separation is measured anew, between the points' marks on either body. The frozen arms
// take away the sideways shift of the load that makes a column of soft contacts buckle, and what is the same in every step
// can come to true rest. The price: the two forces of a contact act up to the tolerance apart, and a resting pair's
// angular momentum is exact only to that. So the tolerance is small against the bodies: what slides or rolls lets go at once,
// and so does what tips. Where there is no weight nothing stands or leans, and no contact is kept: what collides and breaks in
// empty space has its angular momentum to rounding.
#ifndef SCREE_PHYSICS_PERSISTENCE_H
#define SCREE_PHYSICS_PERSISTENCE_H

#include "shaders/physics/solve/contact.h"

LAWS_BEGIN

CONSTANT float KEPT_SLIP = 0.01f;     // of the thinner body's half width: further apart, and the contact is made anew
CONSTANT float KEPT_SPEED = 0.1f;     // of the same in a second: faster, and it slides, rolls or tips
CONSTANT float KEPT_TURN = 0.99905f;  // cosine of half the turn (5 degrees) after which a body's contacts are made anew
// The same where there are one or two points (0.6 degrees, about as much as the slip allows where there are more): a body rocks
// about them without slip, and where the normal of two edges is frozen while they turn, it rocks on for ever.
CONSTANT float KEPT_ROCKING = 0.9999875f;

// What tips over two of its four points falls upon a corner that was not chosen, and is thrown back: columns rocked on for ever.
// So a contact is made anew in every step in which B turns faster than that against A (squared: 0.05 rad/s; with 0.1, four heaps
// of 50 never came to rest),
CONSTANT float KEPT_SPIN_SQUARED = 0.0025f;
// and when it has turned so far (sine of half the turn, squared: 0.4 degrees). With less, columns whose choice of four points
// shifts them by more than that hop between two choices; with degrees, a corner falls 17 mm deep. (To prefer the corners chosen
// before brought no more heaps to rest.)
CONSTANT float KEPT_TILT_SQUARED = 1.225e-5f;

// From the mark of a point on A to its mark on B, as the bodies lie now.
LAW vec3 gap_between_marks(Contact contact, uint point, Pose a, Pose b) {
    vec3 arm = xyz(contact.points[point]);
    vec3 half_gap = contact.normal * (0.5f * contact.points[point].w);
    vec3 mark_a = rotate(a.orientation, rotate_back(contact.orientation_a, arm - half_gap));
    vec3 mark_b = rotate(b.orientation, rotate_back(contact.orientation_b, (arm - contact.center_offset) + half_gap));
    return (b.position - a.position) + mark_b - mark_a;
}

LAW bool has_weight(Parameters parameters) {
    vec3 pull = absolute3(parameters.gravity);
    return pull.x > 1.0e-9f || pull.y > 1.0e-9f || pull.z > 1.0e-9f;
}

LAW float cosine_between(vec4 before, vec4 now) {
    return abs((before.x * now.x + before.y * now.y) + (before.z * now.z + before.w * now.w));
}
LAW vec4 turn_since(vec4 before, vec4 now) {
    vec3 from = vec3(before.x, before.y, before.z), to = vec3(now.x, now.y, now.z);
    vec3 turn = (to * before.w - from * now.w) - cross3(to, from);
    return vec4(turn, now.w * before.w + dot3(to, from));
}
LAW bool turned_little(vec4 before, vec4 now, uint points) {
    return cosine_between(before, now) > (points > 2u ? KEPT_TURN : KEPT_ROCKING);
}

// Whether last step's contact serves for this step: it carried, the bodies do not roll on each other, and its marks
// still lie together.
LAW bool is_persistent(Contact contact, Impulse impulse, BodyProperties ta, Pose a, Velocity va, BodyProperties tb, Pose b,
                       Velocity vb) {
    if (touches_in_a_point(ta.shape) || touches_in_a_point(tb.shape) || (is_round(ta) && is_round(tb))) return false;
    if ((impulse.normal.x + impulse.normal.y) + (impulse.normal.z + impulse.normal.w) <= 0.0f) return false;
    if (!turned_little(contact.orientation_a, a.orientation, contact.count)) return false;
    if (!turned_little(contact.orientation_b, b.orientation, contact.count)) return false;
    vec4 since_a = turn_since(contact.orientation_a, a.orientation), since_b = turn_since(contact.orientation_b, b.orientation);
    vec3 tilt = xyz(since_a) - xyz(since_b);
    vec3 spin = vb.angular - va.angular;
    if (dot3(tilt, tilt) > KEPT_TILT_SQUARED || dot3(spin, spin) > KEPT_SPIN_SQUARED) return false;
    float size = smaller(min_half_width(ta), min_half_width(tb));
    float tolerance = KEPT_SLIP * size;
    float fastest = KEPT_SPEED * size;
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= contact.count) break;
        vec3 slip = gap_between_marks(contact, k, a, b) - contact.normal * contact.points[k].w;
        if (dot3(slip, slip) > tolerance * tolerance) return false;
        vec3 arm = xyz(contact.points[k]);
        vec3 speed = (vb.linear + cross3(vb.angular, arm - contact.center_offset)) - (va.linear + cross3(va.angular, arm));
        if (dot3(speed, speed) > fastest * fastest) return false;
    }
    return true;
}

LAW Manifold persistent_manifold(Contact contact, Pose a, Pose b) {
    Manifold manifold;
    manifold.normal = contact.normal;
    manifold.features = contact.features;
    for (uint k = 0u; k < 4u; ++k) {
        manifold.points[k] = vec4(0.0f);
        if (k < contact.count)
            manifold.points[k] = vec4(xyz(contact.points[k]), dot3(contact.normal, gap_between_marks(contact, k, a, b)));
    }
    return manifold;
}

// Between two bodies that do not stir nothing has changed.
LAW Manifold resting_manifold(Contact contact, Impulse impulse) {
    Manifold manifold;
    manifold.normal = contact.normal;
    manifold.features = contact.features;
    for (uint k = 0u; k < 4u; ++k) {
        manifold.points[k] = vec4(0.0f);
        if (k < contact.count) manifold.points[k] = vec4(xyz(contact.points[k]), impulse.separation[k]);
    }
    return manifold;
}

LAW Contact carry_forward(Contact contact) {
    contact.age = contact.age + 1u;
    return contact;
}
LAW Impulse carry_forward(Contact contact, Impulse was) {
    Impulse impulse = no_impulse(contact.center_offset);
    impulse.normal = was.normal;
    impulse.friction = was.friction;
    impulse.twist = was.twist;
    impulse.rolling = was.rolling;
    return impulse;
}

LAWS_END

#endif
