// The sum of what a body's contacts did to it, in the order of the contacts, how many of them carry, and of what
// the slots tell the sum (what presses) and the least (the least quiet body).
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
