// Makes each contact ready for the step: geometry, masses, and the impulses it inherits.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/collide/grid.h"
#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/extra/tyre.h"
#include "shaders/physics/solve/contact_solver.h"
#include "shaders/physics/solve/persistence.h"
#include "shaders/stages/lib/stage.glsl"

// Between two bodies that sleep, or one that sleeps and one that never moves.
void carry_over(uint i, uint pair_index, uint previous) {
    Contact contact = aged(READ(contacts_before, previous));
    Impulse impulse = continued(contact, READ(impulses_before, previous));
    impulse.separation = separations_of(READ(manifolds, pair_index));
    contacts.at[i] = contact;
    impulses.at[i] = impulse;
    constraints.at[i] = idle_constraint(contact);
    constraints.at[i].a = body_of(contact.a);
    constraints.at[i].b = body_of(contact.b);
}

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts) return;
    uint pair_index = constraints.at[i].pair;
    Pair pair = READ(pairs, pair_index);
    uint slot_a = constraints.at[i].slot_a, slot_b = constraints.at[i].slot_b;
    bool idle = slot_a == NONE && slot_b == NONE;
    if (idle && pair.kind == KIND_STILL) {
        carry_over(i, pair_index, pair.previous);
        return;
    }
    Traits ta = READ(traits, pair.a), tb = READ(traits, pair.b);
    bool has_tyre = tyre_of(ta) != 0u || tyre_of(tb) != 0u;
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    Contact contact =
        contact_of(pair, READ(manifolds, pair_index), READ_WORD(touching, pair_index), READ(poses, of_a), READ(poses, of_b));
    Impulse impulse = no_impulse(contact.d);
    if (pair.kind == KIND_KEPT || pair.kind == KIND_STILL) {
        contact = aged(READ(contacts_before, pair.previous));
        impulse = continued(contact, READ(impulses_before, pair.previous));
    } else if (pair.previous != NONE) {
        Contact before = READ(contacts_before, pair.previous);
        uvec4 matches = matches_of(contact, before, match_radius(ta, tb));
        if (has_tyre) matches = matches_of_tyre(contact, before, tyre_of(ta) != 0u, smaller(thickness(ta), thickness(tb)));
        impulse = inherited(contact, READ(impulses_before, pair.previous), matches);
    }
    impulse.separation = separations_of(READ(manifolds, pair_index));
    if (pair.previous != NONE) {
        bool one_sleeps =
            (slot_a == NONE && motion_of(ta) == MOTION_DYNAMIC) || (slot_b == NONE && motion_of(tb) == MOTION_DYNAMIC);
        contact.load = load_of(one_sleeps, READ(contacts_before, pair.previous), READ(impulses_before, pair.previous));
    }
    if (!idle) impulse.pressed = pressing(impulse);
    contacts.at[i] = contact;
    impulses.at[i] = impulse;
    if (idle) {
        constraints.at[i] = idle_constraint(contact);
        constraints.at[i].a = of_a;
        constraints.at[i].b = of_b;
        return;
    }
    Constraint constraint = constraint_of(contact, ta, tb, slot_a, slot_b, PARAMETERS);
    constraint.a = of_a;
    constraint.b = of_b;
    constraint.pair = pair_index;
    Couple now;
    now.a = READ(velocities, of_a);
    now.b = READ(velocities, of_b);
    if (has_tyre) {
        bool is_a = tyre_of(ta) != 0u;
        Tyre tyre = read_tyre(tyre_of(is_a ? ta : tb) - 1u);
        constraint = on_tyre(constraint, is_a, tyre, contact.d, now);
    }
    constraints.at[i] = constraint;

    Mass ma = lent(READ(masses, of_a), impulse, PARAMETERS);
    Mass mb = lent(READ(masses, of_b), impulse, PARAMETERS);
    float carrying = carries(constraint, impulse, now, PARAMETERS);
    Couple share = warm_start(constraint, impulse, shares_of(now, now, ma, mb), ma, mb);
    if (constraint.slot_a != NONE) slots.at[constraint.slot_a] = slot_of(share.a, carrying, impulse.pressed);
    if (constraint.slot_b != NONE) slots.at[constraint.slot_b] = slot_of(share.b, carrying, impulse.pressed);
}
