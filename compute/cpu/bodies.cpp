// Reference stages over bodies: forces, and the body stages of a substep.
#include <algorithm>
#include <bit>
#include <span>

#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/slot_sums.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/copies.h"
#include "shaders/physics/base/passes.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/driven.h"
#include "shaders/physics/body/grab_spring.h"
#include "shaders/physics/body/mass_splitting.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/periodic_cell.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/impact/impact_state.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

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
    state.scratch.movable_bodies.clear();
    state.scratch.driven_bodies.clear();
    if (!physics::any_stirs(state.counted())) return;
    for (std::uint32_t i = 0; i < state.fixed().bodies; ++i) {
        if (moved_by_contacts(state, i))
            state.scratch.movable_bodies.push_back(i);
        else if (is_driven(state, i))
            state.scratch.driven_bodies.push_back(i);
    }
}

void make_room_for_bodies(State& state, std::size_t lanes) {
    const std::size_t groups = (state.scratch.movable_bodies.size() + lanes - 1) / lanes;
    const std::size_t lines = groups * lanes * words_of_body * sizeof(std::uint32_t) / sizeof(CpuScratch::CacheLine) + 1;
    if (state.scratch.lane_bodies.size() >= lines) return;
    state.scratch.lane_bodies = {};  // freed first; nothing in it lasts from step to step
    state.scratch.lane_bodies.resize(lines);
}
// Calls range(first, last) for ranges that begin with a group of lanes.
template <typename Range>
void for_each_group_of_bodies(std::size_t bodies, const Threads& threads, const WideStages& wide, const Range& range) {
    const auto lanes = static_cast<std::size_t>(wide.lanes);
    threads.for_ranges((bodies + lanes - 1) / lanes,
                       [&](std::size_t first, std::size_t last) { range(first * lanes, std::min(last * lanes, bodies)); },
                       Threads::grain / lanes);
}

void begin_substep_of(State& state, std::size_t i) {
    const SlotSum sum = sum_of_slots(state, i);
    state.velocities[i] =
        physics::integrate_velocity(state.velocities[i], sum.change, state.forces[i], state.properties[i], state.fixed());
    state.masses[i].shares = physics::pack_shares(sum.weight, sum.passed_on);
}

void move(State& state, std::size_t i) {
    const physics::BodyProperties& properties = state.properties[i];
    physics::Velocity velocity = state.velocities[i];
    if (properties.motion == physics::MOTION_DYNAMIC) {
        const SlotSum sum = sum_of_slots(state, i);
        velocity.linear += sum.change.linear;
        velocity.angular += sum.change.angular;
        state.forces[i].impact_weight = sum.weight;
        if (sum.weight > 0) state.impact_debts[i] = sum.passed_on;
    }
    velocity = physics::held_velocity(velocity, state.fixed());
    physics::RigidState after = physics::integrate(state.poses[i], velocity, properties, state.fixed().h);
    const bool sound = physics::is_sound(after.pose) && physics::is_sound(after.velocity);
    if (!sound) {
        state.bounds[i].sweep.marks = physics::UNSOUND;
        after = physics::moved_soundly(sound, state.poses[i], after);
    }
    state.poses[i] = after.pose;
    state.velocities[i] = after.velocity;
    if (!physics::has_isotropic_inertia(properties))
        state.masses[i] = physics::turned_mass(state.masses[i], properties, after.pose.orientation);
}

}  // namespace

void find_parameters_of_copies(State& state) {
    if (state.gravities.empty()) return;
    state.scratch.parameters_of_copies.clear();
    for (const physics::uvec4& gravity : state.gravities) {
        state.scratch.parameters_of_copies.push_back(state.fixed());
        for (int axis = 0; axis < 3; ++axis)
            state.scratch.parameters_of_copies.back().gravity[axis] = std::bit_cast<float>(gravity[axis]);
    }
}

void begin_step(State& state, const Threads& threads, std::uint32_t) {
    std::ranges::fill(state.cell_counts(), 0u);
    std::ranges::fill(state.pair_counts(), 0u);
    std::ranges::fill(state.slot_counts(), 0u);
    std::ranges::fill(state.copy_states, 0u);
    find_parameters_of_copies(state);
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        state.forces[i] = physics::gravity_forces(state.properties[i], parameters_of(state, static_cast<std::uint32_t>(i)));
    });
    if (state.fixed().wake_all)
        for (physics::uint& rest : state.sleep_states) rest = physics::roused(rest, state.fixed().sleep_steps);
    state.counted() = physics::emptied(state.counted(), state.fixed());
}

void enter_cell(State& state, const Threads& threads, std::uint32_t) {
    if (state.fixed().redo) return;  // a repeated step begins where the first attempt did
    threads.for_each(state.fixed().first_part, [&](std::size_t i) {
        if (state.properties[i].motion == physics::MOTION_FIXED) return;
        const physics::Image inside = physics::image_inside(state.poses[i].position, state.fixed());
        state.poses[i] = physics::at_image(state.poses[i], inside);
        state.velocities[i] = physics::at_image(state.velocities[i], inside);
    });
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
        if (!state.fixed().redo) {
            physics::Velocity velocity = physics::apply_impulses(state.velocities[body], action, mass, state.fixed());
            if (physics::changes_velocity(action, properties))
                velocity = physics::velocity_before_substeps(velocity, action, state.fixed());
            state.velocities[body] = velocity;
        }
        physics::uint& rest = state.sleep_states[body];
        rest = sets ? physics::RESTARTS : physics::roused(rest, state.fixed().sleep_steps);
        state.forces[body] = physics::apply_forces(state.forces[body], action, mass);
    }
}

void begin_substep(State& state, const Threads& threads, std::uint32_t pass) {
    if (state.counted().overflow) return;
    const std::uint32_t first = pass & physics::PASS_FIRST, left = pass >> physics::PASS_FOLLOWING;
    if (first != 0) list_moving_bodies(state);
    for (std::size_t i = 0; i < state.fixed().actions; ++i) {
        const physics::Action& action = state.actions[i];
        if (!physics::changes_velocity(action, state.properties[action.body]) || !state.is_stepped(action.body)) continue;
        physics::Velocity& velocity = state.velocities[action.body];
        velocity = physics::velocity_in_substep(velocity, action, left, state.fixed());
    }
    const std::vector<std::uint32_t>& bodies = state.scratch.movable_bodies;
    if (const WideStages* wide = wide_stages(threads.lanes())) {
        if (first != 0) make_room_for_bodies(state, static_cast<std::size_t>(wide->lanes));
        WideTables tables = wide_tables(state, bodies);
        tables.first = first != 0;
        for_each_group_of_bodies(bodies.size(), threads, *wide,
                                 [&](std::size_t begin, std::size_t end) { wide->begin(tables, begin, end); });
    } else {
        threads.for_each(bodies.size(), [&](std::size_t k) { begin_substep_of(state, bodies[k]); });
    }
    const std::span grips = std::span(state.fixed().grips).first(state.fixed().held);
    for (const physics::Grip& grip : grips) {
        if (!moved_by_contacts(state, grip.body)) continue;
        physics::Velocity& velocity = state.velocities[grip.body];
        velocity =
            physics::pulled(velocity, state.poses[grip.body], physics::whole_mass(state.masses[grip.body]), grip, state.fixed());
    }
}

void move_bodies(State& state, const Threads& threads, std::uint32_t) {
    if (state.counted().overflow) return;
    const std::vector<std::uint32_t>&driven = state.scratch.driven_bodies, &bodies = state.scratch.movable_bodies;
    // At rest for a substep, on the way from one velocity to another, a body keeps every bit.
    threads.for_each(driven.size(), [&](std::size_t k) {
        if (physics::in_motion(state.velocities[driven[k]])) move(state, driven[k]);
    });
    const WideStages* wide = wide_stages(threads.lanes());
    if (!wide) return threads.for_each(bodies.size(), [&](std::size_t k) { move(state, bodies[k]); });
    const WideTables tables = wide_tables(state, bodies);
    for_each_group_of_bodies(bodies.size(), threads, *wide,
                             [&](std::size_t begin, std::size_t end) { wide->move(tables, begin, end); });
}

}  // namespace scree::reference
