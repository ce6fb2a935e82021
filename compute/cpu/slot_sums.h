// What contacts and joints change of a body: sums over its slots.
#pragma once

#include "compute/tables/state.h"

namespace scree::reference {

struct SlotSum {
    physics::Velocity change{};
    float weight = 0;
    float passed_on = 0;
};

inline SlotSum sum_of_slots(const State& state, std::size_t body) {
    SlotSum sum;
    for (std::size_t k = state.first_slot_of(body); k < state.slot_ends[body]; ++k) {
        const physics::VelocityDelta& slot = state.slots[k];
        sum.change.linear += slot.linear;
        sum.change.angular += slot.angular;
        sum.weight += slot.weight;
        sum.passed_on += slot.passed_on;
    }
    return sum;
}

}  // namespace scree::reference
