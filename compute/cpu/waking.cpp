// Reference stages of waking.
#include <algorithm>
#include <atomic>

#include "compute/cpu/images.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

std::uint32_t rest_of(State& state, std::uint32_t body) {
    return std::atomic_ref(state.sleep_states[body]).load(std::memory_order_relaxed);
}
void raise(State& state, std::uint32_t body, std::uint32_t bits) {
    if (state.properties[body].motion != physics::MOTION_DYNAMIC) return;
    std::atomic_ref(state.sleep_states[body]).fetch_or(bits, std::memory_order_relaxed);
}
bool slept(State& state, std::uint32_t body) {
    return physics::has_slept(rest_of(state, body), state.fixed().sleep_steps);
}
bool stirred(const State& state, std::uint32_t body) {
    return (state.bounds[body].level & physics::INACTIVE) == 0;
}

bool wakes(State& state, const physics::Pair& pair, std::uint32_t sleeper, std::uint32_t other, float approach) {
    const bool restless = physics::is_restless(state.properties[other].motion, rest_of(state, other));
    const bool touched = pair.previous != physics::NONE;
    return physics::wakes(restless, approach, touched ? physics::normal_impulse(state.impulse_before(pair.previous)) : 0,
                          touched ? state.contacts_before[pair.previous].load : 0, state.properties[sleeper],
                          parameters_of(state, sleeper));
}

// Whether `owner` owns a pair with `other` that has contact points.
bool owner_touches(const State& state, std::uint32_t owner, std::uint32_t other) {
    for (std::size_t i = state.pair_starts[owner]; i < state.pair_starts[owner + 1]; ++i) {
        const physics::Pair& pair = state.pairs[i];
        if ((pair.a == other || pair.b == other) && physics::has_points(state.point_counts[i])) return true;
    }
    return false;
}

}  // namespace

void wake_touched(State& state, const Threads& threads, std::uint32_t) {
    physics::Counts& counts = state.counted();
    if (!counts.sleepers || !physics::any_stirs(counts)) return;
    threads.for_each(counts.contacts, [&](std::size_t i) {
        const std::uint32_t index = state.contact_pairs[i];
        const physics::Pair& pair = state.pairs[index];
        if (!stirred(state, pair.a) && !stirred(state, pair.b)) return;
        const std::uint32_t a = state.body_of(pair.a), b = state.body_of(pair.b);
        const MetBody met = as_met(state, pair.a, pair.b);
        const float approach = physics::approach_of(
            state.scratch.pair_manifolds[index], state.point_counts[index], met.pose.position - state.poses[a].position,
            state.velocities[a], met.velocity,
            physics::speculative_of(state.properties[pair.a], state.properties[pair.b], state.fixed()), state.fixed());
        if (slept(state, a) && !slept(state, b) && wakes(state, pair, a, b, approach)) raise(state, a, physics::WOKEN);
        if (slept(state, b) && !slept(state, a) && wakes(state, pair, b, a, approach)) raise(state, b, physics::WOKEN);
        const std::uint32_t depth = physics::depth_of(approach, state.fixed());
        for (const std::uint32_t body : {a, b}) raise(state, body, physics::shaking_bit(depth));
        if (depth <= 1) return;
        std::atomic_ref(counts.arguments[physics::WORK_WAKE].x).store(counts.arguments[physics::WORK_CONTACTS].x);
        std::atomic_ref(counts.arguments[physics::WORK_WAKE].y).store(counts.arguments[physics::WORK_CONTACTS].y);
    });
}

void wake_unsupported(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow || !state.counted().sleepers || !physics::any_stirs(state.counted())) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        for (std::size_t k = state.first_contacts[i]; k < state.first_contacts[i + 1]; ++k) {
            const physics::Contact& contact = state.contacts_before[k];
            if (stirred(state, contact.a) == stirred(state, contact.b)) continue;
            const std::uint32_t sleeper = state.body_of(stirred(state, contact.a) ? contact.b : contact.a);
            if (!slept(state, sleeper)) continue;
            if (owner_touches(state, contact.a, contact.b) || owner_touches(state, contact.b, contact.a)) continue;
            if (physics::load_changed(0, contact.load, state.properties[sleeper], parameters_of(state, sleeper)))
                raise(state, sleeper, physics::WOKEN);
        }
    });
}

void propagate_wake(State& state, const Threads& threads, std::uint32_t depth) {
    if (state.counted().arguments[physics::WORK_WAKE].x == 0) return;
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        const auto shake = [&](std::uint32_t by, std::uint32_t other) {
            if (physics::shakes(rest_of(state, by), depth)) raise(state, other, physics::shaking_bit(depth - 1));
        };
        const std::uint32_t a = state.body_of(state.contacts[i].a), b = state.body_of(state.contacts[i].b);
        shake(a, b);
        shake(b, a);
    });
}

}  // namespace scree::reference
