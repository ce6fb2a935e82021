// Sums a body's slots in their order: velocity changes, weights and normal impulses (VelocityDelta).
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

struct Gathered {
    Velocity change;
    float weight;
    float normal_impulse;
};

uint first_slot_of(uint body) {
    return body == 0u ? 0u : READ_WORD(slot_ends, body - 1u);
}
Gathered gather(uint body) {
    Gathered sum;
    sum.change = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    sum.weight = 0.0f;
    sum.normal_impulse = 0.0f;
    uint last = READ_WORD(slot_ends, body);
    for (uint k = first_slot_of(body); k < last; ++k) {
        VelocityDelta slot = READ(slots, k);
        sum.change.linear = sum.change.linear + slot.linear;
        sum.change.angular = sum.change.angular + slot.angular;
        sum.weight = sum.weight + slot.weight;
        sum.normal_impulse = sum.normal_impulse + slot.normal_impulse;
    }
    return sum;
}

#endif
