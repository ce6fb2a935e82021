// What the bodies of an impact are doing beside it: their accelerations, joints, and whether they are under a blow.
#ifndef SCREE_PHYSICS_IMPACT_STATE_H
#define SCREE_PHYSICS_IMPACT_STATE_H

#include "shaders/physics/body/mass_splitting.h"
#include "shaders/physics/body/motion.h"

LAWS_BEGIN

// What gravity adds to a speed in a substep, m/s; without gravity, the slowest impact of the settings.
LAW float fall_speed(Parameters parameters) {
    return choose(has_weight(parameters), parameters.h * length3(parameters.gravity), parameters.restitution_threshold);
}

// The normal impulses with which a body begins the substep are a blow if they would change its velocity by more than gravity does
// in so many substeps. A heavy body that has fallen upon a light one is stopped by such impulses, which grow from substep to
// substep; the light one flies to and fro between it and the supports, with energy that the warm start lends and the solution
// takes back. If its contacts returned e^2 of that they would return what nothing ever brought.
CONSTANT float BLOW = 50.0f;
LAW bool is_under_blow(BodyMass body, Parameters parameters) {
    return 0.5f * body.inverse_mass > BLOW * (fall_speed(parameters) * pressed_of(body.shares));
}

// Of a contact with restitution, in a pass.
struct ImpactContext {
    vec3 acceleration;  // of B relative to A, m/s^2
    float debt;         // the contact's part of its bodies' debts (restitution.h), J; in the relax pass
    bool on_joints;     // it moves a body that is on joints
    bool under_blow;    // one of the bodies is under a blow
};
LAW ImpactContext no_impact_context() {
    ImpactContext around;
    around.acceleration = vec3(0.0f);
    around.debt = 0.0f;
    around.on_joints = false;
    around.under_blow = false;
    return around;
}
LAW ImpactContext impact_context(Constraint c, BodyForces a, BodyForces b, BodyMass mass_a, BodyMass mass_b,
                                 Parameters parameters) {
    ImpactContext around;
    around.acceleration = b.acceleration - a.acceleration;
    around.debt = 0.0f;
    around.on_joints = (c.flags & CONSTRAINT_ON_JOINTS) != 0u;
    around.under_blow = is_under_blow(mass_a, parameters) || is_under_blow(mass_b, parameters);
    return around;
}

LAWS_END

#endif
