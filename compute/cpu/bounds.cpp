// Reference bounds of bodies and their places in the grid; poses of parts.
#include <array>
#include <atomic>

#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/copies.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/body/sweep.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree::reference {

namespace {

// Skips the atomic where the bits are set already.
void note(physics::uint& mask, physics::uint bits) {
    const std::atomic_ref all(mask);
    if ((all.load(std::memory_order_relaxed) & bits) != bits) all.fetch_or(bits, std::memory_order_relaxed);
}

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
        float& mark = state.masses[i].shares;
        if (mark < 0) mark = physics::quarantine_code(mark, state.counted().steps);
        return;
    }
    const float bend = physics::is_part(properties) ? physics::bend_of_way(state.part_in(i), velocity, state.fixed()) : 0;
    state.bounds[i] = physics::is_apart(properties)
                          ? physics::no_bounds(pose)
                          : physics::bounds_of(properties, bend, pose, velocity, state.forces[owner], state.fixed());
    state.masses[i] = owner == i ? physics::turned_mass(state.masses[i], properties, pose.orientation) : physics::BodyMass{};
    list_in_grid(state, threads, i, physics::will_sweep(properties, velocity, state.fixed()));
}

}  // namespace

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
    const WideTables all_tables = wide_tables(state, state.scratch.movable_bodies);  // of which ranges set the items
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

}  // namespace scree::reference
