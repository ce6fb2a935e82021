// Periodic cells: what leaves through one side comes back through the opposite one, and a body meets of each other one the
// nearest image. Images of a cell that stretches move relative to the bodies.
#ifndef SCREE_PHYSICS_PERIODIC_CELL_H
#define SCREE_PHYSICS_PERIODIC_CELL_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

#ifndef SCREE_LANES
LAW bool is_periodic(Parameters parameters) {
    return parameters.period.x > 0.0f || parameters.period.y > 0.0f || parameters.period.z > 0.0f;
}
#endif

// An image of a body, or the body itself.
struct Image {
    vec3 periods;   // from the body to the image, each -1, 0 or 1
    vec3 shift;     // the same, m
    vec3 velocity;  // of the image relative to the body, m/s
};
LAW Image image_at(vec3 periods, Parameters parameters) {
    Image image;
    image.periods = periods;
    image.shift = parameters.period * periods;
    image.velocity = image.shift * parameters.cell_rate;
    return image;
}
LAW float periods_to_nearest(float apart, float half_period) {
    return choose(apart > half_period, -1.0f, choose(apart < -half_period, 1.0f, 0.0f));
}
LAW vec3 periods_to_nearest(vec3 apart, Parameters parameters) {
    return vec3(periods_to_nearest(apart.x, parameters.half_period.x), periods_to_nearest(apart.y, parameters.half_period.y),
                periods_to_nearest(apart.z, parameters.half_period.z));
}
// The image of B that A meets. `apart`: from the centre of A to that of B, of bodies, not of parts. Planes have no images.
LAW Image image_of_b(BodyProperties a, BodyProperties b, vec3 apart, Parameters parameters) {
    bool bounded = a.shape != SHAPE_PLANE && b.shape != SHAPE_PLANE;
    vec3 periods = periods_to_nearest(apart, parameters);
    return image_at(choose(bounded, periods, vec3(0.0f)), parameters);
}

LAW Pose at_image(Pose pose, Image image) {
    pose.position = pose.position + image.shift;
    return pose;
}
LAW Velocity at_image(Velocity velocity, Image image) {
    velocity.linear = velocity.linear + image.velocity;
    return velocity;
}
// The pose of an image at the end of a step at whose beginning the body had this one.
LAW Pose end_of_sweep(Pose pose, Image image, Parameters parameters) {
    pose.position = pose.position + image.velocity * parameters.dt;
    return pose;
}

// The image in the flags of a constraint, whose passes ask for no positions.
LAW uint image_flag(float periods, uint axis) {
    uint flag = choose(periods > 0.0f, CONSTRAINT_IMAGE_ON, choose(periods < 0.0f, CONSTRAINT_IMAGE_BACK, 0u));
    return flag << (2u * axis);
}
LAW Constraint meeting_image(Constraint c, Image image) {
    c.flags = c.flags | (image_flag(image.periods.x, 0u) | (image_flag(image.periods.y, 1u) | image_flag(image.periods.z, 2u)));
    return c;
}
LAW float periods_in(uint flags, uint axis) {
    uint own = flags >> (2u * axis);
    return choose((own & CONSTRAINT_IMAGE_ON) != 0u, 1.0f, choose((own & CONSTRAINT_IMAGE_BACK) != 0u, -1.0f, 0.0f));
}
LAW Image image_in(Constraint c, Parameters parameters) {
    vec3 periods = vec3(periods_in(c.flags, 0u), periods_in(c.flags, 1u), periods_in(c.flags, 2u));
    return image_at(periods, parameters);
}

#ifndef SCREE_LANES
// Of a body that has left the cell the image inside, which it becomes.
LAW Image image_inside(vec3 position, Parameters parameters) {
    vec3 out_by = (position - parameters.cell_centre) * parameters.inverse_period;
    return image_at(-floor(out_by + vec3(0.5f)), parameters);
}
#endif

LAWS_END

#endif
