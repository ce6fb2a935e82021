// Reference stages that wake sleepers.
#include <algorithm>
#include <atomic>

#include "compute/reference/stages.h"
#include "shaders/physics/counts.h"
#include "shaders/physics/grid.h"
#include "shaders/physics/rest.h"

namespace scree::reference {

namespace {

std::uint32_t rest_of(State& state, std::uint32_t body) {
    return std::atomic_ref(state.rests[body]).load(std::memory_order_relaxed);
}
void raise(State& state, std::uint32_t body, std::uint32_t rest) {
    std::atomic_ref record(state.rests[body]);
    for (std::uint32_t now = record.load(); now < rest && !record.compare_exchange_weak(now, rest);) continue;
}
bool had_slept(State& state, std::uint32_t body) {
    return physics::has_slept(rest_of(state, body), state.fixed().sleep_steps);
}
bool stirred(const State& state, std::uint32_t body) {
    return (state.bounds[body].level & physics::STILL) == 0;
}

void touch(State& state, const physics::Pair& pair, std::uint32_t index, std::uint32_t sleeper, std::uint32_t other) {
    const physics::Parameters& p = state.fixed();
    float now = 0, then = 0;
    if (pair.previous != physics::NONE) {
        now = physics::pressing(state.impulses_before[pair.previous]);
        then = state.contacts_before[pair.previous].load;
    }
    const float approach = physics::approach_of(state.manifolds[index], state.touching[index],
                                                state.poses[pair.b].position - state.poses[pair.a].position,
                                                state.velocities[pair.a], state.velocities[pair.b], p);
    const bool restless = physics::is_restless(state.traits[other].motion, rest_of(state, other));
    const std::uint32_t depth = physics::waking(restless, approach, now, then, state.traits[sleeper], p);
    if (depth > 0) raise(state, sleeper, physics::woken(rest_of(state, sleeper), depth));
    if (depth > 1) {
        physics::Counts& counts = state.counted();
        std::atomic_ref(counts.arguments[physics::WORK_SHAKEN].x).store(counts.arguments[physics::WORK_CONTACTS].x);
    }
}

// Whether the pairs that `owner` found tell of a contact with `other`.
bool owner_touches(const State& state, std::uint32_t owner, std::uint32_t other) {
    for (std::size_t i = state.pair_starts[owner]; i < state.pair_starts[owner + 1]; ++i) {
        const physics::Pair& pair = state.pairs[i];
        if ((pair.a == other || pair.b == other) && state.touching[i] > 0) return true;
    }
    return false;
}

}  // namespace

void wake_touched(State& state, const Threads& threads, std::uint32_t) {
    if (!state.counted().sleepers) return;
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        const std::uint32_t index = state.constraints[i].pair;
        const physics::Pair& pair = state.pairs[index];
        if (had_slept(state, pair.a) && !had_slept(state, pair.b) && stirred(state, pair.b))
            touch(state, pair, index, pair.a, pair.b);
        if (had_slept(state, pair.b) && !had_slept(state, pair.a) && stirred(state, pair.a))
            touch(state, pair, index, pair.b, pair.a);
    });
}

void wake_deserted(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow || !state.counted().sleepers) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        for (std::size_t k = state.first_contacts_before[i]; k < state.first_contacts_before[i + 1]; ++k) {
            const physics::Contact& contact = state.contacts_before[k];
            if (stirred(state, contact.a) == stirred(state, contact.b)) continue;
            const std::uint32_t sleeper = stirred(state, contact.a) ? contact.b : contact.a;
            if (!had_slept(state, sleeper)) continue;
            if (owner_touches(state, contact.a, contact.b) || owner_touches(state, contact.b, contact.a)) continue;
            if (physics::load_changed(0, contact.load, state.traits[sleeper], state.fixed()))
                raise(state, sleeper, physics::woken(rest_of(state, sleeper), 1));
        }
    });
}

void shake_sleepers(State& state, const Threads& threads, std::uint32_t depth) {
    if (state.counted().arguments[physics::WORK_SHAKEN].x == 0) return;
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        const physics::Pair& pair = state.pairs[state.constraints[i].pair];
        const auto shake = [&](std::uint32_t by, std::uint32_t sleeper) {
            const std::uint32_t rest = rest_of(state, sleeper);
            if (physics::shaking(rest_of(state, by)) == depth && had_slept(state, sleeper))
                raise(state, sleeper, physics::shaken(rest, depth - 1));
        };
        shake(pair.a, pair.b);
        shake(pair.b, pair.a);
    });
}

}  // namespace scree::reference
