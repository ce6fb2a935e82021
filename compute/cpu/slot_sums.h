// What contacts and joints change of a body: sums over its slots.
#pragma once

#include "compute/tables/state.h"

namespace scree::reference {

struct SlotSum {
    physics::Velocity change{};
    float weight = 0;
    float normal_impulse = 0;
};

inline SlotSum sum_of_slots(const State& state, std::size_t body) {
    SlotSum sum;
    for (std::size_t k = state.first_slot_of(body); k < state.slot_ends[body]; ++k) {
        const physics::VelocityDelta& slot = state.slots[k];
        sum.change.linear += slot.linear;
        sum.change.angular += slot.angular;
        sum.weight += slot.weight;
        sum.normal_impulse += slot.normal_impulse;
    }
    return sum;
}

}  // namespace scree::reference
