// Reference stages over bodies: loads, bounds, and the body halves of a substep.
#include <algorithm>
#include <atomic>

#include "compute/reference/stages.h"
#include "shaders/physics/block.h"
#include "shaders/physics/counts.h"
#include "shaders/physics/grid.h"
#include "shaders/physics/motion.h"

namespace scree::reference {

namespace {

struct Sum {
    physics::Velocity change{};
    float carrying = 0;
};

Sum sum_of_slots(const State& state, std::size_t body) {
    Sum sum;
    const auto first = state.slots.begin() + (body == 0 ? 0 : state.slot_ends[body - 1]);
    const auto last = state.slots.begin() + state.slot_ends[body];
    std::for_each(first, last, [&](const physics::Slot& slot) {
        sum.change.linear += slot.linear;
        sum.change.angular += slot.angular;
        sum.carrying += slot.carries;
    });
    return sum;
}

}  // namespace

void begin_step(State& state, const Threads& threads, std::uint32_t) {
    std::fill(state.cells.begin(), state.cells.end(), 0u);
    std::fill(state.pair_starts.begin(), state.pair_starts.end(), 0u);
    std::fill(state.slot_ends.begin(), state.slot_ends.end(), 0u);
    threads.for_each(state.fixed().bodies,
                     [&](std::size_t i) { state.loads[i] = physics::gravity_load(state.traits[i], state.fixed()); });
    state.counted() = physics::emptied(state.counted(), state.fixed());
}

void apply_actions(State& state, const Threads&, std::uint32_t) {
    if (state.counted().overflow) return;
    for (std::size_t i = 0; i < state.fixed().actions; ++i) {
        const physics::Action& action = state.actions[i];
        const std::size_t body = action.body;
        const physics::Mass mass = physics::mass_in_world(state.traits[body], state.poses[body].orientation, 1);
        if (!state.fixed().redo) state.velocities[body] = physics::kicked(state.velocities[body], action, mass, state.fixed());
        state.loads[body] = physics::loaded(state.loads[body], action, mass);
    }
}

void bound_bodies(State& state, const Threads& threads, std::uint32_t) {
    std::atomic_ref levels(state.counted().levels), fast(state.counted().fast);
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const physics::Traits& traits = state.traits[i];
        state.bounds[i] = physics::bounds_of(traits, state.poses[i], state.velocities[i], state.loads[i], state.fixed());
        state.flights[i] = physics::flight_of(state.poses[i]);
        if (physics::will_be_fast(traits, state.velocities[i], state.fixed())) fast.store(1, std::memory_order_relaxed);
        state.masses[i] = physics::mass_in_world(traits, state.poses[i].orientation, 1);
        std::atomic_ref(state.cells[state.bounds[i].bucket]).fetch_add(1, std::memory_order_relaxed);
        if (!traits.large) levels.fetch_or(1u << state.bounds[i].level, std::memory_order_relaxed);
    });
}

void begin_substep(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        if (state.traits[i].motion != physics::MOTION_DYNAMIC) return;
        const Sum sum = sum_of_slots(state, i);
        state.velocities[i] =
            physics::accelerated(state.velocities[i], sum.change, state.loads[i], state.traits[i], state.fixed());
        state.masses[i].split = physics::split_of(sum.carrying, state.fixed());
    });
}

void move_bodies(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const physics::Traits& traits = state.traits[i];
        if (traits.motion == physics::MOTION_FIXED) return;
        physics::Velocity velocity = state.velocities[i];
        if (traits.motion == physics::MOTION_DYNAMIC) {
            const Sum sum = sum_of_slots(state, i);
            velocity.linear += sum.change.linear;
            velocity.angular += sum.change.angular;
            state.loads[i].blows = sum.carrying;
        }
        const physics::Moved after = physics::moved(state.poses[i], velocity, traits, state.fixed().h);
        state.poses[i] = after.pose;
        state.velocities[i] = after.velocity;
        if (!physics::turns_evenly(traits))
            state.masses[i] = physics::mass_in_world(traits, after.pose.orientation, state.masses[i].split);
    });
}

void end_step(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    ++state.counted().steps;
    std::atomic<bool> any_fast = false;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        if (state.traits[i].motion != physics::MOTION_DYNAMIC) return;
        const Sum sum = sum_of_slots(state, i);
        physics::Velocity& velocity = state.velocities[i];
        velocity.linear = physics::without_dust(velocity.linear + sum.change.linear);
        velocity.angular = physics::without_dust(velocity.angular + sum.change.angular);
        const physics::Traits& traits = state.traits[i];
        physics::Flight& flight = state.flights[i];
        if (!physics::was_fast(traits, flight, state.poses[i])) return;
        flight = physics::stopped_at(flight, physics::seen_part(traits, flight, state.poses[i], state.bounds[i]));
        any_fast.store(true, std::memory_order_relaxed);
    });
    if (!any_fast) return;
    state.counted().fast = 1;
    state.counted().arguments[physics::WORK_FLIGHTS] = state.counted().arguments[physics::WORK_PAIRS];
}

}  // namespace scree::reference
