// Sums a body's slots in their order: velocity changes, weights and normal impulses (VelocityDelta).
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

const uint LONG_LIST = 32u;  // slots

struct Gathered {
    Velocity change;
    float weight;
    float passed_on;
};

uint first_slot_of(uint body) {
    return body == 0u ? 0u : READ_WORD(slot_ends, body - 1u);
}
Gathered added(Gathered sum, VelocityDelta slot) {
    sum.change.linear = sum.change.linear + slot.linear;
    sum.change.angular = sum.change.angular + slot.angular;
    sum.weight = sum.weight + slot.weight;
    sum.passed_on = sum.passed_on + slot.passed_on;
    return sum;
}
Gathered gather(uint body) {
    Gathered sum;
    sum.change = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    sum.weight = 0.0f;
    sum.passed_on = 0.0f;
    uint k = first_slot_of(body), last = READ_WORD(slot_ends, body);
    // Four a round of a long list, which then waits less for memory; lavapipe silently ends a shader's loops after 65,535 rounds.
    for (; k + LONG_LIST <= last; k += 4u) {
        VelocityDelta one = READ(slots, k), two = READ(slots, k + 1u), three = READ(slots, k + 2u), four = READ(slots, k + 3u);
        sum = added(added(added(added(sum, one), two), three), four);
    }
    for (; k < last; ++k) sum = added(sum, READ(slots, k));
    return sum;
}

#endif
