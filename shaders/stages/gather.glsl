// The sum of what a body's contacts did to it, in the order of the contacts, and how many of them carry.
#ifndef SCREE_STAGES_GATHER_GLSL
#define SCREE_STAGES_GATHER_GLSL

struct Gathered {
    Velocity change;
    float carrying;
};

Gathered gather(uint body) {
    Gathered sum;
    sum.change = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
    sum.carrying = 0.0f;
    uint last = slot_ends[body];
    for (uint k = body == 0u ? 0u : slot_ends[body - 1u]; k < last; ++k) {
        Slot slot = slots[k];
        sum.change.linear = sum.change.linear + slot.linear;
        sum.change.angular = sum.change.angular + slot.angular;
        sum.carrying = sum.carrying + slot.carries;
    }
    return sum;
}

#endif
