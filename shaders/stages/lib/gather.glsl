// Sums a body's slots in their order: velocity changes, active contacts and payloads (VelocityDelta); and the least payload.
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

struct Gathered {
    Velocity change;
    float carrying;
    float least_payload;
    float payload_sum;
};

Gathered gather(uint body) {
    Gathered sum;
    sum.change = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    sum.carrying = 0.0f;
    sum.least_payload = FOREVER;
    sum.payload_sum = 0.0f;
    uint last = READ_WORD(slot_ends, body);
    for (uint k = body == 0u ? 0u : READ_WORD(slot_ends, body - 1u); k < last; ++k) {
        VelocityDelta slot = READ(slots, k);
        sum.change.linear = sum.change.linear + slot.linear;
        sum.change.angular = sum.change.angular + slot.angular;
        sum.carrying = sum.carrying + slot.is_active;
        sum.payload_sum = sum.payload_sum + slot.payload;
        if (slot.is_active > 0.0f) sum.least_payload = smaller(sum.least_payload, slot.payload);
    }
    return sum;
}

#endif
