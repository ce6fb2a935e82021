// Contacts of shapes with a curved side or rim, predicted at the middle of the step.
//
// Contact points are fixed to a body through a step, which is right for rolling on a circle. Under a rocking ellipsoid
// the point moves, and one from the start of the step lags by half a step: it pulls back too late, and the rocking
// grows by a tenth in a second. Likewise the lowest point of a tilted cylinder runs round its rim, 20 to 40 degrees in a
// step: one in a heap wobbled at 1.3 rad/s for ever, against its rolling resistance. The point at the middle of the step
// is right on average.
#ifndef SCREE_PHYSICS_ROLLING_CONTACT_H
#define SCREE_PHYSICS_ROLLING_CONTACT_H

#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/sweep.h"
#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// Limits of the prediction: rad, and a part of the smaller min_half_width. With more, a fast body would be predicted
// behind what it is about to strike.
CONSTANT float MOST_TURN_AHEAD = 0.2f;
CONSTANT float MOST_WAY_AHEAD = 0.25f;
// The way of a rim by rotation, of the smaller min_half_width. With more, a flat face seen ahead has a single point, at
// the side that comes down: pushed up in turn, coins rocked at 5 rad/s and sank into the ground.
CONSTANT float MOST_RIM_AHEAD = 0.05f;

// Time by which a pair is predicted, s; 0: not at all.
LAW float time_ahead(BodyProperties a, Velocity va, BodyProperties b, Velocity vb, Parameters parameters) {
    if (!has_curved_side(a.shape) && !has_curved_side(b.shape)) return 0.0f;
    float ahead = 0.5f * parameters.dt;
    float turn = length3(va.angular) + length3(vb.angular);
    float way = length3(vb.linear - va.linear);
    float most_way = MOST_WAY_AHEAD * smaller(min_half_width(a), min_half_width(b));
    if (turn * ahead > MOST_TURN_AHEAD) ahead = MOST_TURN_AHEAD * reciprocal(turn);
    if (way * ahead > most_way) ahead = most_way * reciprocal(way);
    if (!is_smooth(a.shape) && !is_smooth(b.shape)) {
        float rim = length3(va.angular) * lever_of(a) + length3(vb.angular) * lever_of(b);
        float most_rim = MOST_RIM_AHEAD * smaller(min_half_width(a), min_half_width(b));
        if (rim * ahead > most_rim) ahead = most_rim * reciprocal(rim);
    }
    return ahead;
}
LAW Pose pose_ahead(Pose pose, Velocity velocity, float ahead) {
    Pose after = pose;
    after.position = pose.position + velocity.linear * ahead;
    after.orientation = turned(pose.orientation, velocity.angular, ahead);
    return after;
}

LAW float speed_at(Manifold manifold, vec4 point, Velocity va, Velocity vb, vec3 d) {
    vec3 of_a = va.linear + cross3(va.angular, xyz(point));
    vec3 of_b = vb.linear + cross3(vb.angular, xyz(point) - d);
    return dot3(manifold.normal, of_b - of_a);
}
// The manifold of predicted poses (d: their offset) brought back to the present: points where they will be on the
// anchor body, separations as at present.
LAW ManifoldBuffer brought_back(ManifoldBuffer touch, BodyProperties a, Velocity va, BodyProperties b, Velocity vb, vec3 d,
                                float ahead) {
    vec3 back = stays_with_b(a, b) ? (va.linear - vb.linear) * ahead : vec3(0.0f);
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= touch.count) continue;
        vec4 point = touch.manifold.points[k];
        float separation = point.w - ahead * speed_at(touch.manifold, point, va, vb, d);
        vec3 at = xyz(point) + back;
        touch.manifold.points[k] = vec4(at.x, at.y, at.z, separation);
    }
    return touch;
}

LAWS_END

#endif
