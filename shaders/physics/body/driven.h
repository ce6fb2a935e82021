// A kinematic body whose velocity was set: it changes evenly over the substeps of the next step.
//
// A velocity that jumps at the start of a step asks of the first substep's friction what the whole step's can bear: a box slid on
// platforms that sped up with more than mu g / substeps (by 40 mm in 2 s at 4 m/s^2, where 4.9 can be borne). With an even
// change a platform that gains a dt in each step speeds up with a, and reaches each velocity at the end of the step in which
// it was set. The mean velocity of that step stands for the body before the substeps, so that bounds and predicted sweeps end
// where the body will.
#ifndef SCREE_PHYSICS_DRIVEN_H
#define SCREE_PHYSICS_DRIVEN_H

#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/sweep.h"

LAWS_BEGIN

LAW bool changes_velocity(Action action, BodyProperties properties) {
    return (action.flags & ACTION_CHANGES_VELOCITY) != 0u && properties.motion == MOTION_KINEMATIC;
}
// `left`: part of the change that is still to come.
LAW Velocity on_the_way(Velocity velocity, Action action, float left, Parameters parameters) {
    velocity.linear = action.velocity;
    velocity.angular = action.angular_velocity;
    velocity = clamp_velocity(velocity, parameters);
    velocity.linear = flush_tiny(velocity.linear - (velocity.linear - action.velocity_before) * left);
    velocity.angular = flush_tiny(velocity.angular - (velocity.angular - action.angular_velocity_before) * left);
    return velocity;
}
// In the mean of the step. One that turns back so that this is 0 would be taken for a body at rest: it jumps.
LAW Velocity mean_velocity(Velocity velocity, Action action, Parameters parameters) {
    return on_the_way(velocity, action, 0.5f - 0.5f * (parameters.h * reciprocal(parameters.dt)), parameters);
}
LAW Velocity velocity_before_substeps(Velocity velocity, Action action, Parameters parameters) {
    Velocity mean = mean_velocity(velocity, action, parameters);
    if (in_motion(mean)) return mean;
    return on_the_way(velocity, action, 0.0f, parameters);
}
// In a substep that `left` others follow.
LAW Velocity velocity_in_substep(Velocity velocity, Action action, uint left, Parameters parameters) {
    float part = float(left) * (parameters.h * reciprocal(parameters.dt));
    return on_the_way(velocity, action, in_motion(mean_velocity(velocity, action, parameters)) ? part : 0.0f, parameters);
}

LAWS_END

#endif
