// Sums a body's slots in their order: velocity changes, active contacts, and `told` (the sum of normal impulses; in the
// last pass the least quiet steps).
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

struct Gathered {
    Velocity change;
    float carrying;
    float told;
    float normal_impulse;
};

Gathered gather(uint body) {
    Gathered sum;
    sum.change = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    sum.carrying = 0.0f;
    sum.told = FOREVER;
    sum.normal_impulse = 0.0f;
    uint last = READ_WORD(slot_ends, body);
    for (uint k = body == 0u ? 0u : READ_WORD(slot_ends, body - 1u); k < last; ++k) {
        VelocityDelta slot = READ(slots, k);
        sum.change.linear = sum.change.linear + slot.linear;
        sum.change.angular = sum.change.angular + slot.angular;
        sum.carrying = sum.carrying + slot.is_active;
        sum.normal_impulse = sum.normal_impulse + slot.told;
        if (slot.is_active > 0.0f) sum.told = smaller(sum.told, slot.told);
    }
    return sum;
}

#endif
