// Fracture: threshold, impulse limit, and the motion of fragments.
//
// Fragments are cut before the first step, pre-allocated and inactive, so fracture needs no allocation and no host
// round trip. A body breaks at the end of the step in which one contact's normal impulse, plus the greatest of the
// previous step, exceeds the threshold: an impact may straddle two steps. So a steady load counts twice its impulse per
// step. A threshold of momentum is compared with the body's own as the step began, and a contact must take at least a
// tenth of it.
//
// A breaking body cannot bear more than its threshold. Its contacts keep the part threshold / impulse of what they
// applied in that step; the rest is returned to both bodies at one point and in opposite directions: what strikes a
// pane goes on nearly as fast as it came. Linear and angular momentum are conserved. Fragments then move as parts of
// the rigid body, v + w x r and w; their masses, centres and inertias sum to the body's (compute/scene/fracture.h), so
// the momentum is the same.
#ifndef SCREE_PHYSICS_FRACTURE_H
#define SCREE_PHYSICS_FRACTURE_H

#include "shaders/physics/body/motion.h"
#include "shaders/physics/contact/contact_solver.h"

LAWS_BEGIN

// Of a momentum threshold: a contact with a smaller impulse does not break the body, else sliding would.
CONSTANT float LEAST_BLOW = 0.1f;

LAW bool may_break(BodyProperties properties) {
    return properties.fracture != NONE && properties.motion == MOTION_DYNAMIC;
}

// What is stored for the next step, N s: the greatest contact impulse, or the momentum.
LAW float strain_after(Fracturing fracturing, float blow, BodyProperties properties, Velocity velocity) {
    if (fracturing.of_momentum == 0u) return blow;
    return length3(velocity.linear) * reciprocal(properties.inverse_mass);
}
// The part of the contacts' impulses that stays, 1 if the body does not break. `blow`: the greatest impulse of one
// contact, N s; `strain`: stored by the previous step, N s.
LAW float kept_part(Fracturing fracturing, float blow, float strain) {
    float felt = fracturing.of_momentum == 0u ? blow + strain : strain;
    float least = fracturing.of_momentum == 0u ? 0.0f : LEAST_BLOW * fracturing.threshold;
    if (!(felt > fracturing.threshold) || !(blow > least)) return 1.0f;
    return fracturing.threshold * reciprocal(felt);
}

// The velocity after a contact returns `impulse`, N s, to body A (side 0) or B.
LAW Velocity given_back(Velocity velocity, Mass mass, Constraint c, Impulse contact, uint side, float impulse) {
    c = refresh_round_contact(c, contact.center_offset);
    LeverArms r = lever_arms(c, c.centre, contact.center_offset);
    vec3 push = side == 0u ? c.normal * impulse : c.normal * -impulse;
    velocity.linear = velocity.linear + push * mass.inverse_mass;
    velocity.angular = velocity.angular + turned_by(mass, cross3(side == 0u ? r.a : r.b, push));
    return velocity;
}

// A fragment's pose and velocity, as a part of the rigid body.
LAW RigidState piece_of(PoseInBody piece, Pose pose, Velocity velocity) {
    vec3 arm = rotate(pose.orientation, piece.position);
    vec3 way = arm + vec3(pose.low_x, velocity.low_y, velocity.low_z);
    RigidState part;
    part.pose.position = pose.position + way;
    vec3 rest = way - (part.pose.position - pose.position);
    part.pose.low_x = rest.x;
    part.pose.orientation = unit_quaternion(compose(pose.orientation, piece.orientation));
    part.velocity.linear = velocity.linear + cross3(velocity.angular, arm);
    part.velocity.low_y = rest.y;
    part.velocity.angular = velocity.angular;
    part.velocity.low_z = rest.z;
    return part;
}

LAWS_END

#endif
