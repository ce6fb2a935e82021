// The sum of what a body's contacts did to it, in the order of the contacts, how many of them carry, and the quietness of the
// least quiet body behind these.
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

struct Gathered {
    Velocity change;
    float carrying;
    float told;
};

Gathered gather(uint body) {
    Gathered sum;
    sum.change = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    sum.carrying = 0.0f;
    sum.told = FOREVER;
    uint last = slot_ends[body];
    for (uint k = body == 0u ? 0u : slot_ends[body - 1u]; k < last; ++k) {
        Slot slot = slots[k];
        sum.change.linear = sum.change.linear + slot.linear;
        sum.change.angular = sum.change.angular + slot.angular;
        sum.carrying = sum.carrying + slot.carries;
        if (slot.carries > 0.0f) sum.told = smaller(sum.told, slot.quiet);
    }
    return sum;
}

#endif
