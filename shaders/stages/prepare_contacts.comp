// Makes each contact ready for the step: geometry, masses, and the impulses it inherits.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/physics/grid.h"
#include "shaders/physics/persistence.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

// Between two bodies that sleep, or one that sleeps and one that never moves.
void carry_over(uint i, uint pair_index, uint previous) {
    Contact contact = aged(contacts_before.at[previous]);
    Impulse impulse = continued(contact, impulses_before.at[previous]);
    impulse.separation = separations_of(manifolds.at[pair_index]);
    contacts.at[i] = contact;
    impulses.at[i] = impulse;
    constraints.at[i] = idle_constraint(contact);
}

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts) return;
    uint pair_index = constraints.at[i].pair;
    Pair pair = pairs.at[pair_index];
    uint slot_a = constraints.at[i].slot_a, slot_b = constraints.at[i].slot_b;
    bool idle = slot_a == NONE && slot_b == NONE;
    if (idle && pair.kind == KIND_STILL) {
        carry_over(i, pair_index, pair.previous);
        return;
    }
    Traits ta = traits.at[pair.a], tb = traits.at[pair.b];
    Contact contact = contact_of(pair, manifolds.at[pair_index], touching.at[pair_index], poses.at[pair.a], poses.at[pair.b]);
    Impulse impulse = no_impulse(contact.d);
    if (pair.kind == KIND_KEPT || pair.kind == KIND_STILL) {
        contact = aged(contacts_before.at[pair.previous]);
        impulse = continued(contact, impulses_before.at[pair.previous]);
    } else if (pair.previous != NONE) {
        impulse = inherited(contact, contacts_before.at[pair.previous], impulses_before.at[pair.previous], match_radius(ta, tb));
    }
    impulse.separation = separations_of(manifolds.at[pair_index]);
    if (pair.previous != NONE) {
        bool one_sleeps = (slot_a == NONE && ta.motion == MOTION_DYNAMIC) || (slot_b == NONE && tb.motion == MOTION_DYNAMIC);
        contact.load = load_of(one_sleeps, contacts_before.at[pair.previous], impulses_before.at[pair.previous]);
    }
    if (!idle) impulse.pressed = pressing(impulse);
    contacts.at[i] = contact;
    impulses.at[i] = impulse;
    if (idle) {
        constraints.at[i] = idle_constraint(contact);
        return;
    }
    Constraint constraint = constraint_of(contact, ta, tb, slot_a, slot_b, PARAMETERS);
    constraint.pair = pair_index;
    constraints.at[i] = constraint;

    Mass ma = lent(masses.at[pair.a], impulse, PARAMETERS);
    Mass mb = lent(masses.at[pair.b], impulse, PARAMETERS);
    Couple now;
    now.a = velocities.at[pair.a];
    now.b = velocities.at[pair.b];
    float carrying = carries(constraint, impulse, now, PARAMETERS);
    Couple share = warm_start(constraint, impulse, shares_of(now, now, ma, mb), ma, mb);
    if (constraint.slot_a != NONE) slots.at[constraint.slot_a] = slot_of(share.a, carrying, impulse.pressed);
    if (constraint.slot_b != NONE) slots.at[constraint.slot_b] = slot_of(share.b, carrying, impulse.pressed);
}
