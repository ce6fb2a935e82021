// Compounds: a part is a collider with a row of its own, posed by its body.
//
// Every collider is a row: a body of one convex shape, a part of a compound, a triangle of a mesh. Pairs and persistent
// contacts are identified by rows, so several contacts of two bodies match across steps. Motion, sleep and waking
// belong to bodies: contacts of a part act on its owner, relative to the owner's centre.
#ifndef SCREE_PHYSICS_COMPOUND_H
#define SCREE_PHYSICS_COMPOUND_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

LAW bool is_part(BodyProperties properties) {
    return (properties.motion & MOTION_OF_PART) != 0u;
}
// The motion of the body that a row belongs to.
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

// How far a part's path in a step deviates from its velocity, m, because its body rotates.
LAW float bend_of_way(PoseInBody part, Velocity velocity, Parameters parameters) {
    float turn_squared = dot3(velocity.angular, velocity.angular) * (parameters.dt * parameters.dt);
    return 0.5f * turn_squared * length3(part.position);
}

LAWS_END

#endif
