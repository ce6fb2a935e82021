// What a contact that is carried forward takes from the last step: its impulses and its load.
#ifndef SCREE_PHYSICS_CARRIED_CONTACT_H
#define SCREE_PHYSICS_CARRIED_CONTACT_H

#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/mass_splitting.h"

LAWS_BEGIN

LAW Impulse no_impulse(vec3 d) {
    Impulse impulse;
    impulse.normal = vec4(0.0f);
    impulse.separation = vec4(0.0f);
    impulse.impact = vec4(0.0f);
    impulse.rebound_energy = 0.0f;
    impulse.impact_energy = 0.0f;
    impulse.impact_weight = 0.0f;
    impulse.flight_energy = 0.0f;
    impulse.speed_before_push = 0.0f;
    impulse.response = 0.0f;
    impulse.friction = vec3(0.0f);
    impulse.twist = 0.0f;
    impulse.rolling = vec3(0.0f);
    impulse.slide_distance = 0.0f;
    impulse.center_offset = d;
    impulse.normal_sum = 0.0f;
    impulse.stretch = vec3(0.0f);
    impulse.turn = 0.0f;
    return impulse;
}

LAW vec4 separations_of(Manifold manifold) {
    return vec4(manifold.points[0].w, manifold.points[1].w, manifold.points[2].w, manifold.points[3].w);
}

// Whether the contact keeps its points and impulses: it persists, or both bodies are inactive.
LAW bool is_carried_forward(uint pair_type) {
    return pair_type == PAIR_PERSISTENT || pair_type == PAIR_INACTIVE;
}
// A contact that persists keeps its impulses.
LAW Impulse carry_forward(Contact contact, Impulse was) {
    Impulse impulse = no_impulse(contact.center_offset);
    impulse.normal = was.normal;
    impulse.impact = was.impact;
    impulse.rebound_energy = was.rebound_energy;
    impulse.impact_energy = was.impact_energy;
    impulse.speed_before_push = was.speed_before_push;
    impulse.friction = was.friction;
    impulse.twist = was.twist;
    impulse.rolling = was.rolling;
    impulse.stretch = was.stretch;
    impulse.turn = was.turn;
    return impulse;
}
// The same with the separations of this step.
LAW Impulse carried_impulse(Contact before, Impulse was, Manifold manifold) {
    Impulse impulse = carry_forward(before, was);
    impulse.separation = separations_of(manifold);
    return impulse;
}

// A sleeper's contact keeps the load of the last step in which both bodies were awake.
LAW float load_of(bool one_sleeps, Contact before, Impulse was) {
    return choose(one_sleeps, before.load, normal_impulse(was));
}
// The load that waking compares with the present one (sleep.h): a dynamic body without a slot sleeps.
LAW float load_since(Contact before, Impulse was, BodyProperties a, uint slot_a, BodyProperties b, uint slot_b) {
    bool a_sleeps = slot_a == NONE && motion_of(a) == MOTION_DYNAMIC;
    bool b_sleeps = slot_b == NONE && motion_of(b) == MOTION_DYNAMIC;
    return load_of(a_sleeps || b_sleeps, before, was);
}

LAWS_END

#endif
