// The impulse of a contact from its two records, and back.
#ifndef SCREE_PHYSICS_CONTACT_IMPULSE_H
#define SCREE_PHYSICS_CONTACT_IMPULSE_H

#include "shaders/physics/base/records.h"

LAWS_BEGIN

// A ContactImpulse and a ContactImpact, as the solver computes with them. Tables have them apart, because most scenes have no
// restitution.
struct Impulse {
    vec4 normal, separation;
    vec4 impact;
    float rebound_energy, impact_energy, impact_weight, flight_energy;
    vec3 friction;
    float twist;
    vec3 rolling;
    float slide_distance;
    vec3 center_offset;
    float normal_sum;
    vec3 stretch;
    float turn;
    float speed_before_push, response;
};

LAW ContactImpact no_impact() {
    ContactImpact none;
    none.impact = vec4(0.0f);
    none.rebound_energy = 0.0f;
    none.impact_energy = 0.0f;
    none.impact_weight = 0.0f;
    none.flight_energy = 0.0f;
    none.speed_before_push = 0.0f;
    none.response = 0.0f;
    none.pad0 = 0.0f;
    none.pad1 = 0.0f;
    return none;
}
LAW Impulse whole_impulse(ContactImpulse kept, ContactImpact impact) {
    Impulse impulse;
    impulse.normal = kept.normal;
    impulse.separation = kept.separation;
    impulse.impact = impact.impact;
    impulse.rebound_energy = impact.rebound_energy;
    impulse.impact_energy = impact.impact_energy;
    impulse.impact_weight = impact.impact_weight;
    impulse.flight_energy = impact.flight_energy;
    impulse.speed_before_push = impact.speed_before_push;
    impulse.response = impact.response;
    impulse.friction = kept.friction;
    impulse.twist = kept.twist;
    impulse.rolling = kept.rolling;
    impulse.slide_distance = kept.slide_distance;
    impulse.center_offset = kept.center_offset;
    impulse.normal_sum = kept.normal_sum;
    impulse.stretch = kept.stretch;
    impulse.turn = kept.turn;
    return impulse;
}
LAW ContactImpulse contact_impulse_of(Impulse impulse) {
    ContactImpulse kept;
    kept.normal = impulse.normal;
    kept.separation = impulse.separation;
    kept.friction = impulse.friction;
    kept.twist = impulse.twist;
    kept.rolling = impulse.rolling;
    kept.slide_distance = impulse.slide_distance;
    kept.center_offset = impulse.center_offset;
    kept.normal_sum = impulse.normal_sum;
    kept.stretch = impulse.stretch;
    kept.turn = impulse.turn;
    return kept;
}
LAW ContactImpact contact_impact_of(Impulse impulse) {
    ContactImpact impact;
    impact.impact = impulse.impact;
    impact.rebound_energy = impulse.rebound_energy;
    impact.impact_energy = impulse.impact_energy;
    impact.impact_weight = impulse.impact_weight;
    impact.flight_energy = impulse.flight_energy;
    impact.speed_before_push = impulse.speed_before_push;
    impact.response = impulse.response;
    impact.pad0 = 0.0f;
    impact.pad1 = 0.0f;
    return impact;
}

LAWS_END

#endif
