// Bodies made of parts: a part is a row of its own that touches, and lies where its body carries it.
//
// Whatever touches is a row: a body of one convex shape, a part of a compound, a triangle of a mesh. Pairs, and the contacts of
// the last step, are known by their rows, so several contacts of two bodies each find what they were. All that moves, sleeps and
// wakes is a body: what touches a part touches its owner, and is counted from the owner's centre.
#ifndef SCREE_PHYSICS_COMPOUND_H
#define SCREE_PHYSICS_COMPOUND_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

LAW bool is_part(BodyProperties properties) {
    return (properties.motion & MOTION_OF_PART) != 0u;
}
// How the body moves that a row belongs to.
LAW uint motion_of(BodyProperties properties) {
    return properties.motion & 3u;
}

LAW Pose pose_of_part(PoseInBody part, Pose owner) {
    Pose pose;
    pose.position = owner.position + rotate(owner.orientation, part.position);
    pose.low_x = 0.0f;
    pose.orientation = compose(owner.orientation, part.orientation);
    return pose;
}
LAW Velocity velocity_of_part(PoseInBody part, Pose owner, Velocity velocity) {
    Velocity own = velocity;
    own.linear = velocity.linear + cross3(velocity.angular, rotate(owner.orientation, part.position));
    own.low_y = 0.0f;
    own.low_z = 0.0f;
    return own;
}

// How far a part's way in a step bends away from its velocity, m: its body turns.
LAW float bend_of_way(PoseInBody part, Velocity velocity, Parameters parameters) {
    float turn_squared = dot3(velocity.angular, velocity.angular) * (parameters.dt * parameters.dt);
    return 0.5f * turn_squared * length3(part.position);
}

LAWS_END

#endif
