// Reference end of a step: the last velocities of bodies, their sleep, and quarantine of what is not finite.
#include <algorithm>
#include <array>
#include <atomic>

#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/slot_sums.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/continuous/clamping.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

// Of the active contacts' and joints' other bodies, the least quiet steps.
float least_quiet_beside(const State& state, std::size_t body) {
    float quiet = physics::FOREVER;
    if (state.fixed().sleep_steps == physics::NO_SLEEP) return quiet;
    for (std::size_t k = state.first_slot_of(body); k < state.slot_ends[body]; ++k)
        if (state.slots[k].weight > 0) quiet = std::min(quiet, state.neighbours_quiet[k]);
    return quiet;
}

void put_into_quarantine(State& state, std::size_t i, float mark) {
    state.properties[i].motion = physics::MOTION_QUARANTINED;
    state.masses[i].shares = mark;
    state.velocities[i] = {};
    state.sleep_states[i] = 0;
}

// What the step leaves of a movable body whose velocity is that after the last substep, with marks of BodyEnd. Whether the body
// has a sweep to check for impacts.
bool end_body(State& state, std::size_t i, unsigned marks) {
    physics::Velocity& velocity = state.velocities[i];
    const physics::BodyProperties& properties = state.properties[i];
    const bool moved = state.bounds[i].sweep.marks != physics::UNSOUND;
    if (!moved || (marks & is_unsound) != 0) {
        put_into_quarantine(state, i, moved ? physics::AFTER_STEP : physics::AFTER_MOVE);
        std::atomic_ref(state.counted().quarantined).fetch_add(1, std::memory_order_relaxed);
        return false;
    }
    if ((marks & is_spin_limited) != 0) std::atomic_ref(state.counted().spin_limited).fetch_add(1, std::memory_order_relaxed);
    const physics::uint sleep_steps = state.fixed().sleep_steps;
    const float pace = sleep_steps != physics::NO_SLEEP ? physics::pace_of(properties, velocity, state.fixed()) : 0;
    const float carrying = (marks & carries_contacts) != 0 ? 1.0f : 0.0f;
    state.sleep_states[i] =
        physics::sleep_state_after(state.sleep_states[i], pace, carrying, least_quiet_beside(state, i), sleep_steps);
    if (physics::is_asleep(state.sleep_states[i], sleep_steps)) velocity.linear = velocity.angular = physics::vec3(0);
    if ((marks & was_fast) == 0) return false;
    physics::Sweep& sweep = state.bounds[i].sweep;
    sweep = physics::stopped_at(sweep, physics::seen_part(properties, sweep, state.poses[i], state.bounds[i]));
    return true;
}

// Scalar version of WideStages::finish().
unsigned finish(State& state, std::size_t i) {
    const SlotSum sum = sum_of_slots(state, i);
    physics::Velocity& velocity = state.velocities[i];
    velocity.linear = physics::flush_tiny(velocity.linear + sum.change.linear);
    velocity.angular = physics::flush_tiny(velocity.angular + sum.change.angular);
    unsigned marks = sum.weight != 0 ? carries_contacts : 0u;
    if (physics::is_spin_limited(velocity, state.fixed())) marks |= is_spin_limited;
    velocity = physics::held_velocity(velocity, state.fixed());
    if (!physics::is_sound(velocity)) marks |= is_unsound;
    if (physics::was_fast(state.properties[i], state.bounds[i].sweep, state.poses[i])) marks |= was_fast;
    return marks;
}

}  // namespace

void end_step(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    ++state.counted().steps;
    std::atomic<bool> any_fast = false;
    const WideStages* wide = wide_stages(threads.lanes());
    const std::vector<std::uint32_t>& bodies = state.scratch.movable_bodies;
    const WideTables all_tables = wide_tables(state, bodies);
    threads.for_ranges(bodies.size(), [&](std::size_t begin, std::size_t end) {
        std::array<std::uint8_t, 128> marks;
        WideTables tables = all_tables;
        tables.marks = marks.data();
        bool fast = false;
        for (std::size_t first = begin; first < end; first += marks.size()) {
            const std::size_t count = std::min(marks.size(), end - first);
            tables.items = bodies.data() + first;
            if (wide) wide->finish(tables, 0, count);
            for (std::size_t k = 0; k < count; ++k) {
                const std::uint32_t body = bodies[first + k];
                fast |= end_body(state, body, wide ? marks[k] : finish(state, body));
            }
        }
        if (fast) any_fast.store(true, std::memory_order_relaxed);
    });
    if (!any_fast) return;
    state.counted().fast = 1;
    state.counted().arguments[physics::WORK_CCD_PAIRS] = state.counted().arguments[physics::WORK_PAIRS];
}

}  // namespace scree::reference
