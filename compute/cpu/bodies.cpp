// Reference stages over bodies: forces, bounds, and the body stages of a substep.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <span>

#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/copies.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/compound.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/extra/grab_spring.h"
#include "shaders/physics/extra/quarantine.h"
#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/contact_solver.h"
#include "shaders/physics/solve/mass_scaling.h"
#include "shaders/physics/solve/motion.h"

namespace scree::reference {

namespace {

struct Sum {
    physics::Velocity change{};
    float weight = 0;
    float normal_impulse = 0;
};

std::size_t first_slot_of(const State& state, std::size_t body) {
    return body == 0 ? 0 : state.slot_ends[body - 1];
}

Sum sum_of_slots(const State& state, std::size_t body) {
    Sum sum;
    for (std::size_t k = first_slot_of(state, body); k < state.slot_ends[body]; ++k) {
        const physics::VelocityDelta& slot = state.slots[k];
        sum.change.linear += slot.linear;
        sum.change.angular += slot.angular;
        sum.weight += slot.weight;
        sum.normal_impulse += slot.normal_impulse;
    }
    return sum;
}

// Of the active contacts' and joints' other bodies, the least quiet steps.
float least_quiet_beside(const State& state, std::size_t body) {
    float quiet = physics::FOREVER;
    if (state.fixed().sleep_steps == physics::NO_SLEEP) return quiet;
    for (std::size_t k = first_slot_of(state, body); k < state.slot_ends[body]; ++k)
        if (state.slots[k].weight > 0) quiet = std::min(quiet, state.neighbours_quiet[k]);
    return quiet;
}

bool asleep(const State& state, std::size_t body) {
    return physics::is_asleep(state.sleep_states[body], state.fixed().sleep_steps);
}
bool moved_by_contacts(const State& state, std::size_t body) {
    return physics::is_movable(state.properties[body].motion, state.sleep_states[body], state.fixed().sleep_steps) &&
           state.is_stepped(body);
}

// Kinematic bodies in motion.
bool is_driven(const State& state, std::size_t body) {
    return state.properties[body].motion == physics::MOTION_KINEMATIC && !physics::is_part(state.properties[body]) &&
           physics::in_motion(state.velocities[body]) && !asleep(state, body) && state.is_stepped(body);
}

// Motions and sleep change neither within a step's substeps.
void list_moving_bodies(State& state) {
    state.movable_bodies.clear();
    state.driven_bodies.clear();
    if (!physics::any_stirs(state.counted())) return;
    for (std::uint32_t i = 0; i < state.fixed().bodies; ++i) {
        if (moved_by_contacts(state, i))
            state.movable_bodies.push_back(i);
        else if (is_driven(state, i))
            state.driven_bodies.push_back(i);
    }
}

void make_room_for_bodies(State& state, std::size_t lanes) {
    const std::size_t groups = (state.movable_bodies.size() + lanes - 1) / lanes;
    const std::size_t lines = groups * lanes * words_of_body * sizeof(std::uint32_t) / sizeof(State::CacheLine) + 1;
    if (state.lane_bodies.size() >= lines) return;
    state.lane_bodies = {};  // freed first; nothing in it lasts from step to step
    state.lane_bodies.resize(lines);
}
// Calls range(first, last) for ranges that begin with a group of lanes.
template <typename Range>
void for_each_group_of_bodies(std::size_t bodies, const Threads& threads, const WideStages& wide, const Range& range) {
    const auto lanes = static_cast<std::size_t>(wide.lanes);
    threads.for_ranges((bodies + lanes - 1) / lanes,
                       [&](std::size_t first, std::size_t last) { range(first * lanes, std::min(last * lanes, bodies)); },
                       Threads::grain / lanes);
}

// Skips the atomic where the bits are set already.
void note(physics::uint& mask, physics::uint bits) {
    const std::atomic_ref all(mask);
    if ((all.load(std::memory_order_relaxed) & bits) != bits) all.fetch_or(bits, std::memory_order_relaxed);
}

// Steps of the copy that a body belongs to.
physics::uint age_of(const State& state, std::size_t body) {
    const physics::uint steps = state.counted().steps;
    return state.has_copies() ? physics::age_of_copy(steps, state.births[state.copy_of(static_cast<std::uint32_t>(body))])
                              : steps;
}

void begin_substep_of(State& state, std::size_t i, bool first) {
    const Sum sum = sum_of_slots(state, i);
    const physics::BodyProperties& properties = state.properties[i];
    const float scale = physics::mass_scale(state.masses[i], properties);
    physics::Velocity change = sum.change;
    if (scale > 1) {
        physics::ScaledMotion& motion = state.scaled_motions[i];
        const physics::ScaledChange scaled =
            physics::with_acceleration(change, state.velocities[i], motion, state.forces[i], scale, state.fixed());
        change = scaled.change;
        motion = scaled.motion;
    }
    const physics::BodyForces load = physics::scaled_forces(state.forces[i], scale);
    state.velocities[i] = physics::integrate_velocity(state.velocities[i], change, load, properties, state.fixed());
    float& split_state = state.masses[i].split_state;
    if (first) split_state = physics::update_hysteresis(split_state, sum.weight, age_of(state, i));
    split_state = physics::split_state_after(split_state, sum.weight, sum.normal_impulse);
}

void scale_mass(State& state, std::size_t i) {
    physics::BodyMass& mass = state.masses[i];
    const physics::BodyProperties& properties = state.properties[i];
    const physics::Parameters& felt = felt_by(state, static_cast<std::uint32_t>(i));
    const float scale = physics::next_mass_scale(mass, properties, state.velocities[i], felt);
    if (scale > 1) {
        physics::ScaledMotion& motion = state.scaled_motions[i];
        motion = physics::next_scaled_motion(motion, mass, properties, state.velocities[i], felt);
    }
    if (scale != physics::mass_scale(mass, properties))
        mass = physics::mass_with_scale(mass, properties, state.poses[i].orientation, scale);
}

void move(State& state, std::size_t i) {
    const physics::BodyProperties& properties = state.properties[i];
    physics::Velocity velocity = state.velocities[i];
    if (properties.motion == physics::MOTION_DYNAMIC) {
        const Sum sum = sum_of_slots(state, i);
        velocity.linear += sum.change.linear;
        velocity.angular += sum.change.angular;
        state.forces[i].impacts = physics::impacts_of(sum.weight, properties);
        if (sum.weight > 0) state.impact_debts[i] = sum.normal_impulse;
    }
    physics::RigidState after = physics::integrate(state.poses[i], velocity, properties, state.fixed().h);
    const bool sound = physics::is_sound(after.pose) && physics::is_sound(after.velocity);
    if (!sound) {
        state.forces[i].kept = physics::UNSOUND;
        after = physics::moved_soundly(sound, state.poses[i], after);
    }
    state.poses[i] = after.pose;
    state.velocities[i] = after.velocity;
    if (!physics::has_isotropic_inertia(properties))
        state.masses[i] = physics::mass_with_scale_of(state.masses[i], properties, after.pose.orientation);
}

void put_into_quarantine(State& state, std::size_t i, float mark) {
    state.properties[i].motion = physics::MOTION_QUARANTINED;
    state.masses[i].split_state = mark;
    state.velocities[i] = {};
    state.forces[i].kept = 1;
    state.sleep_states[i] = 0;
}

// ---- compute_bounds

// Counts a row with known bounds in its grid cell, and notes for later stages its level and whether it moves, sleeps or sweeps.
void list_in_grid(State& state, const Threads& threads, std::size_t i, bool sweeps) {
    physics::Counts& counts = state.counted();
    const physics::uint sleep_steps = state.fixed().sleep_steps;
    const physics::BodyProperties& properties = state.properties[i];
    const std::uint32_t owner = state.body_of(static_cast<std::uint32_t>(i));
    physics::Bounds& bounds = state.bounds[i];
    if (sweeps) note(counts.fast, 1u);
    const bool stirs =
        physics::stirs(physics::motion_of(properties), state.velocities[owner], state.sleep_states[owner], sleep_steps);
    const bool large = physics::is_large(properties);
    const bool listed = !large && bounds.level != physics::NOT_IN_GRID;
    if (listed) note(counts.levels, 1u << bounds.level);
    if (listed && stirs) note(counts.levels_stirring, 1u << bounds.level);
    if (!listed && stirs) note(counts.large_stirring, large ? 1u : 2u);
    if (physics::has_slept(state.sleep_states[i], sleep_steps)) note(counts.sleepers, 1u);
    if (state.has_copies()) {
        const std::uint32_t copy = state.copy_of(owner);
        if (bounds.bucket != physics::NONE) bounds = physics::of_copy(bounds, copy, state.fixed());
        if (stirs) note(state.copy_states[copy], physics::COPY_STIRS);
    }
    if (bounds.bucket != physics::NONE) taken(threads, state.cell_counts()[bounds.bucket]);
    if (!stirs) bounds.level |= physics::INACTIVE;
}

bool is_bounded_in_lanes(const State& state, std::size_t i) {
    const physics::BodyProperties& properties = state.properties[i];
    return !physics::is_part(properties) && !physics::is_out_of_play(properties.motion) && !physics::is_apart(properties) &&
           !physics::was_set(state.sleep_states[i]) && state.is_here(i);
}

void bound(State& state, const Threads& threads, std::size_t i) {
    // Copies: else the compiler assumes that the writes below alias them, and computes twice.
    const physics::BodyProperties properties = state.properties[i];
    const physics::Pose pose = state.poses[i];
    if (physics::is_absent(properties.motion) || !state.is_here(i)) {
        state.bounds[i] = physics::no_bounds(pose);
        return;
    }
    const physics::Velocity velocity = state.velocities[i];
    const std::uint32_t owner = state.body_of(static_cast<std::uint32_t>(i));
    if (physics::is_quarantined(state.properties[owner].motion)) {
        state.bounds[i] = physics::no_bounds(pose);
        float& mark = state.masses[i].split_state;
        if (mark < 0) mark = physics::quarantine_code(mark, state.counted().steps);
        return;
    }
    const float bend = physics::is_part(properties) ? physics::bend_of_way(state.part_in(i), velocity, state.fixed()) : 0;
    state.bounds[i] = physics::is_apart(properties)
                          ? physics::no_bounds(pose)
                          : physics::bounds_of(properties, bend, pose, velocity, state.forces[owner], state.fixed());
    const float scale = physics::was_set(state.sleep_states[i]) ? 1 : physics::mass_scale(state.masses[i], properties);
    state.masses[i] =
        owner == i ? physics::mass_with_scale(state.masses[i], properties, pose.orientation, scale) : physics::BodyMass{};
    list_in_grid(state, threads, i, physics::will_sweep(properties, velocity, state.fixed()));
}

// ---- end_step

// What the step leaves of a movable body whose velocity is that after the last substep, with marks of BodyEnd. Whether the body
// has a sweep to check for impacts.
bool end_body(State& state, std::size_t i, unsigned marks) {
    physics::Velocity& velocity = state.velocities[i];
    const physics::BodyProperties& properties = state.properties[i];
    const bool moved = state.forces[i].kept != physics::UNSOUND;
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
    if (asleep(state, i)) velocity.linear = velocity.angular = physics::vec3(0);
    if ((marks & was_fast) == 0) return false;
    physics::Sweep& sweep = state.bounds[i].sweep;
    sweep = physics::stopped_at(sweep, physics::seen_part(properties, sweep, state.poses[i], state.bounds[i]));
    return true;
}

// Scalar version of WideStages::finish().
unsigned finish(State& state, std::size_t i) {
    const Sum sum = sum_of_slots(state, i);
    physics::Velocity& velocity = state.velocities[i];
    velocity.linear = physics::flush_tiny(velocity.linear + sum.change.linear);
    velocity.angular = physics::flush_tiny(velocity.angular + sum.change.angular);
    unsigned marks = sum.weight != 0 ? carries_contacts : 0u;
    if (!physics::is_sound(velocity)) marks |= is_unsound;
    if (physics::is_spin_limited(velocity, state.fixed())) marks |= is_spin_limited;
    velocity = physics::held_velocity(velocity, state.fixed());
    if (physics::was_fast(state.properties[i], state.bounds[i].sweep, state.poses[i])) marks |= was_fast;
    return marks;
}

}  // namespace

void feel_gravities(State& state) {
    if (state.gravities.empty()) return;
    state.felt.clear();
    for (const physics::uvec4& gravity : state.gravities) {
        state.felt.push_back(state.fixed());
        for (int axis = 0; axis < 3; ++axis) state.felt.back().gravity[axis] = std::bit_cast<float>(gravity[axis]);
    }
}

void begin_step(State& state, const Threads& threads, std::uint32_t) {
    std::ranges::fill(state.cell_counts(), 0u);
    std::ranges::fill(state.pair_counts(), 0u);
    std::ranges::fill(state.slot_counts(), 0u);
    std::ranges::fill(state.copy_states, 0u);
    feel_gravities(state);
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        state.forces[i] = physics::gravity_forces(state.properties[i], felt_by(state, static_cast<std::uint32_t>(i)));
    });
    if (state.fixed().wake_all)
        for (physics::uint& rest : state.sleep_states) rest = physics::roused(rest, state.fixed().sleep_steps);
    state.counted() = physics::emptied(state.counted(), state.fixed());
}

void apply_actions(State& state, const Threads&, std::uint32_t) {
    if (state.counted().overflow) return;
    for (std::size_t i = 0; i < state.fixed().actions; ++i) {
        const physics::Action& action = state.actions[i];
        const std::size_t body = action.body;
        if (physics::is_out_of_play(state.properties[body].motion) || !state.is_stepped(body)) continue;
        const physics::BodyProperties& properties = state.properties[body];
        const physics::Mass mass = physics::mass_in_world(properties, state.poses[body].orientation);
        const bool sets = (action.flags & physics::ACTION_SETS_VELOCITY) != 0 && properties.motion == physics::MOTION_DYNAMIC;
        const bool begins = sets || physics::was_set(state.sleep_states[body]);
        if (!state.fixed().redo) {
            const physics::Mass struck =
                physics::scaled_mass(mass, begins ? 1.0f : physics::mass_scale(state.masses[body], properties));
            state.velocities[body] = physics::apply_impulses(state.velocities[body], action, struck, state.fixed());
        }
        physics::uint& rest = state.sleep_states[body];
        rest = sets ? physics::RESTARTS : physics::roused(rest, state.fixed().sleep_steps);
        state.forces[body] = physics::apply_forces(state.forces[body], action, mass);
    }
}

void pose_parts(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const std::size_t first = state.fixed().first_part;
    threads.for_each(state.fixed().bodies - first, [&](std::size_t k) {
        const physics::BodyProperties& properties = state.properties[first + k];
        if (physics::motion_of(properties) == physics::MOTION_FIXED) return;
        const physics::Pose& owner = state.poses[properties.owner];
        state.velocities[first + k] = physics::velocity_of_part(state.parts[k], owner, state.velocities[properties.owner]);
        state.poses[first + k] = physics::pose_of_part(state.parts[k], owner);
    });
}

void compute_bounds(State& state, const Threads& threads, std::uint32_t) {
    const WideStages* wide = wide_stages(threads.lanes());
    const WideTables all_tables = wide_tables(state, state.movable_bodies);  // of which ranges set the items
    threads.for_ranges(state.fixed().bodies, [&](std::size_t begin, std::size_t end) {
        std::array<std::uint32_t, 128> rows;
        std::array<std::uint8_t, rows.size()> sweeping;
        std::size_t listed = 0;
        WideTables tables = all_tables;
        tables.items = rows.data();
        tables.marks = sweeping.data();
        const auto bound_listed = [&] {
            if (listed > 0) wide->bound(tables, 0, listed);
            for (std::size_t k = 0; k < listed; ++k) list_in_grid(state, threads, rows[k], sweeping[k] != 0);
            listed = 0;
        };
        for (std::size_t i = begin; i < end; ++i) {
            if (!wide || !is_bounded_in_lanes(state, i)) {
                bound(state, threads, i);
            } else {
                rows[listed++] = static_cast<std::uint32_t>(i);
                if (listed == rows.size()) bound_listed();
            }
        }
        bound_listed();
    });
}

void begin_substep(State& state, const Threads& threads, std::uint32_t first) {
    if (state.counted().overflow) return;
    if (first != 0) list_moving_bodies(state);
    const std::vector<std::uint32_t>& bodies = state.movable_bodies;
    if (const WideStages* wide = wide_stages(threads.lanes())) {
        if (first != 0) make_room_for_bodies(state, static_cast<std::size_t>(wide->lanes));
        WideTables tables = wide_tables(state, bodies);
        tables.first = first != 0;
        tables.steps = state.counted().steps;
        std::vector<std::uint32_t> ages;
        if (first && state.has_copies()) {
            ages.resize(state.fixed().bodies);
            threads.for_each(ages.size(), [&](std::size_t i) { ages[i] = age_of(state, i); });
            tables.ages = ages.data();
        }
        for_each_group_of_bodies(bodies.size(), threads, *wide,
                                 [&](std::size_t begin, std::size_t end) { wide->begin(tables, begin, end); });
    } else {
        threads.for_each(bodies.size(), [&](std::size_t k) { begin_substep_of(state, bodies[k], first != 0); });
    }
    const std::span grips = std::span(state.fixed().grips).first(state.fixed().held);
    for (const physics::Grip& grip : grips) {
        if (!moved_by_contacts(state, grip.body)) continue;
        physics::Velocity& velocity = state.velocities[grip.body];
        velocity =
            physics::pulled(velocity, state.poses[grip.body], physics::whole_mass(state.masses[grip.body]), grip, state.fixed());
    }
    if (first == 0) return;
    const WideStages* wide = wide_stages(threads.lanes());
    if (!wide || !state.gravities.empty())
        return threads.for_each(bodies.size(), [&](std::size_t k) { scale_mass(state, bodies[k]); });
    const WideTables tables = wide_tables(state, bodies);
    threads.for_ranges(bodies.size(), [&](std::size_t begin, std::size_t end) { wide->scale(tables, begin, end); });
}

void move_bodies(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const std::vector<std::uint32_t>&driven = state.driven_bodies, &bodies = state.movable_bodies;
    threads.for_each(driven.size(), [&](std::size_t k) { move(state, driven[k]); });
    const WideStages* wide = wide_stages(threads.lanes());
    if (!wide) return threads.for_each(bodies.size(), [&](std::size_t k) { move(state, bodies[k]); });
    const WideTables tables = wide_tables(state, bodies);
    for_each_group_of_bodies(bodies.size(), threads, *wide,
                             [&](std::size_t begin, std::size_t end) { wide->move(tables, begin, end); });
}

void end_step(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    ++state.counted().steps;
    std::atomic<bool> any_fast = false;
    const WideStages* wide = wide_stages(threads.lanes());
    const std::vector<std::uint32_t>& bodies = state.movable_bodies;
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
