// When a body breaks, and what becomes of its motion.
//
// How a body comes apart is known before the first step: fragments are pre-allocated and inactive, so fracture needs no
// allocation and no host round trip. It breaks at the end of the step in which one contact has carried more than its threshold:
// the normal impulse that the contact handed it in this step and the greatest that one handed it in the step before, because a
// blow that falls between two steps is one blow. So a load that stays counts twice what it presses with in a step. A threshold of
// momentum is that of the body itself as the step began; it breaks if it had more, and a contact takes at least a tenth of the
// threshold from it.
//
// A body that breaks cannot bear more than its threshold. So of what its contacts carried in that step they keep the part
// threshold / impulse, and the rest is given back, to both bodies at one place and in opposite directions: what strikes a pane
// goes on nearly as fast as it came, and what a frame held stays with the frame. Linear and angular momentum are kept. Then the
// pieces go on as parts of a rigid body do, v + w x r and w; their masses add up to the body's, their places to its centre and
// their inertia to its own (compute/scene/fracture.h), so that it is the same momentum.
#ifndef SCREE_PHYSICS_FRACTURE_H
#define SCREE_PHYSICS_FRACTURE_H

#include "shaders/physics/solve/contact_solver.h"
#include "shaders/physics/solve/motion.h"

LAWS_BEGIN

// Of a threshold of momentum: less is no blow but a touch, and what slides along the ground would break.
CONSTANT float LEAST_BLOW = 0.1f;

LAW bool may_break(BodyProperties properties) {
    return properties.fracture != NONE && properties.motion == MOTION_DYNAMIC;
}

// What a body remembers for the next step, N s: the blow, or its momentum.
LAW float strain_after(Fracturing fracturing, float blow, BodyProperties properties, Velocity velocity) {
    if (fracturing.of_momentum == 0u) return blow;
    return length3(velocity.linear) * reciprocal(properties.inverse_mass);
}
// The part of their impulses that its contacts keep, 1 if it stays whole. `blow`: the greatest impulse of one contact, N s;
// `strain`: what the step before left.
LAW float kept_part(Fracturing fracturing, float blow, float strain) {
    float felt = fracturing.of_momentum == 0u ? blow + strain : strain;
    float least = fracturing.of_momentum == 0u ? 0.0f : LEAST_BLOW * fracturing.threshold;
    if (!(felt > fracturing.threshold) || !(blow > least)) return 1.0f;
    return fracturing.threshold * reciprocal(felt);
}

// A body's velocity when a contact of it gives back `impulse`, N s. Of A: side 0.
LAW Velocity given_back(Velocity velocity, Mass mass, Constraint c, Impulse contact, uint side, float impulse) {
    c = refresh_round_contact(c, contact.center_offset);
    LeverArms r = lever_arms(c, c.centre, contact.center_offset);
    vec3 push = side == 0u ? c.normal * impulse : c.normal * -impulse;
    velocity.linear = velocity.linear + push * mass.inverse_mass;
    velocity.angular = velocity.angular + turned_by(mass, cross3(side == 0u ? r.a : r.b, push));
    return velocity;
}

// A piece of the body where it belongs, and as fast as a part of the whole.
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
