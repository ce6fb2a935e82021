// Warm starting across steps: the impulses of this step's contacts, taken from those of the last step.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/contact_preparation.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/images.glsl"
#include "shaders/stages/lib/impulses.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts) return;
    Pair pair = READ(pairs, READ_WORD(contact_pairs, i));
    PreparedContact prepared = without_impulses(READ(contacts, i));
    uint slot_a = READ_WORD(contact_slots, 2u * i), slot_b = READ_WORD(contact_slots, 2u * i + 1u);
    bool idle = is_idle(slot_a, slot_b);
    if (pair.previous == NONE) {
        keep_impulse(i, prepared.impulse);
        return;
    }
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    Contact before = READ(contacts_before, pair.previous);
    Impulse was = impulse_before(pair.previous);
    BodyProperties ta = READ(properties, pair.a), tb = READ(properties, pair.b);
    Pose pose_b = READ(poses, of_b);
    Velocity velocity_b = READ(velocities, of_b);
    if (PERIODIC) {
        Image image = image_met(ta, of_a, tb, of_b);
        pose_b = at_image(pose_b, image);
        velocity_b = at_image(velocity_b, image);
    }
    if (pair.pair_type == PAIR_INACTIVE)
        prepared = carried_forward(before, was, resting_manifold(before, was));
    else if (pair.pair_type == PAIR_PERSISTENT)
        prepared = carried_forward(before, was, persistent_manifold(before, READ(poses, of_a), pose_b));
    else
        prepared = warm_started(prepared, before, was, ta, tb);
    if (!idle || pair.pair_type != PAIR_INACTIVE) prepared.contact.load = load_since(before, was, ta, slot_a, tb, slot_b);
    if (!idle) prepared.impulse.normal_sum = normal_impulse(prepared.impulse);
    if (BOUNCES && !idle && rebounds_across(contact_impact_of(prepared.impulse))) {
        Parameters own = parameters_of(of_a);
        VelocityPair now;
        now.a = READ(velocities, of_a);
        now.b = velocity_b;
        prepared.impulse = settled_impact(prepared.impulse, constraint_of(prepared.contact, ta, tb, slot_a, slot_b, own), was,
                                          constraint_of(before, ta, tb, slot_a, slot_b, own), now);
    }
    keep_impulse(i, prepared.impulse);
    contacts.at[i].load = prepared.contact.load;
}
