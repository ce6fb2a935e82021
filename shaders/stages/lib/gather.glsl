// The sum of what a body's contacts did to it, in the order of the contacts, how many of them carry, and of what
// the slots tell the sum (what presses) and the least (the least quiet body).
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

struct Gathered {
    Velocity change;
    float carrying;
    float told;
    float pressing;
};

Gathered gather(uint body) {
    Gathered sum;
    sum.change = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    sum.carrying = 0.0f;
    sum.told = FOREVER;
    sum.pressing = 0.0f;
    uint last = READ_WORD(slot_ends, body);
    for (uint k = body == 0u ? 0u : READ_WORD(slot_ends, body - 1u); k < last; ++k) {
        Slot slot = READ(slots, k);
        sum.change.linear = sum.change.linear + slot.linear;
        sum.change.angular = sum.change.angular + slot.angular;
        sum.carrying = sum.carrying + slot.carries;
        sum.pressing = sum.pressing + slot.told;
        if (slot.carries > 0.0f) sum.told = smaller(sum.told, slot.told);
    }
    return sum;
}

#endif
