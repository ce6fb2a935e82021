// Sums a body's slots in their order: velocity changes, weights and normal impulses (VelocityDelta).
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

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
    if (k >= last) return sum;
    // Two a round: lavapipe silently ends a shader's loops after 65,535 rounds, and a GPU waits less for memory.
    do {
        VelocityDelta one = READ(slots, k), two = READ(slots, min(k + 1u, last - 1u));
        sum = added(sum, one);
        if (k + 1u < last) sum = added(sum, two);
        k += 2u;
    } while (k < last);
    return sum;
}

#endif
