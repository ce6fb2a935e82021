// Stages over bodies, one per lane: bounds, the two stages of a substep, and the end of a step. For
// compute/cpu/simd/simd_stages.cpp.
#pragma once

#include "compute/cpu/simd/lane_items.h"

LAWS_BEGIN

namespace {

// The marks of these items.
SCREE_INLINE void set_marks(const WideTables& tables, std::size_t first, std::size_t last, Uint marks) {
    for (std::size_t lane = 0; lane < lanes && lane < last - first; ++lane)
        tables.marks[first + lane] = static_cast<std::uint8_t>(marks.v[lane]);
}

void bound(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices bodies(listed(tables.items, first, last)), live = bodies.only(living(first, last));
        const BodyProperties properties = gather<BodyProperties>(tables.properties, bodies);
        const Pose pose = gather<Pose>(tables.poses, bodies);
        const Velocity velocity = gather<Velocity>(tables.velocities, bodies);
        const BodyForces load = gather<BodyForces>(tables.forces, bodies);
        scatter(tables.bounds, live, bounds_of(properties, 0.0f, pose, velocity, load, p));
        scatter(tables.masses, live, turned_mass(gather<BodyMass>(tables.masses, bodies), properties, pose.orientation));
        set_marks(tables, first, last, choose(will_sweep(properties, velocity, p), 1u, 0u));
    }
}

// Sums each body's slots in their order. A slot is eight floats, added as one vector.
SCREE_INLINE VelocityDelta sums_of_slots(const WideTables& tables, const Indices& bodies) {
    using Eight [[gnu::vector_size(32)]] = float;
    std::uint32_t sums[8 * SCREE_LANES];
    for (int lane = 0; lane < lanes; ++lane) {
        const std::uint32_t body = bodies.of[lane];
        Eight sum = {};
        for (std::uint32_t slot = body == 0 ? 0 : tables.slot_ends[body - 1]; slot < tables.slot_ends[body]; ++slot) {
            Eight change;
            __builtin_memcpy(&change, tables.slots + std::size_t{8} * slot, sizeof change);
            sum += change;
        }
        __builtin_memcpy(sums + 8 * lane, &sum, sizeof sum);
    }
    return gather<VelocityDelta>(sums, Indices(lane_numbers()));
}

// Of a group of bodies what stays through a step, from begin of the first substep on.
struct KeptBodies {
    vec3 acceleration;
    Float linear_damping;
    vec3 angular_acceleration;
    Float angular_damping;
    vec3 inverse_inertia;
    Float inverse_mass;
    Uint motion;
};
static_assert(sizeof(KeptBodies) == reference::words_of_body * sizeof(Words));

// As records, of which the other members are not read.
struct BodyGroup {
    BodyProperties properties;
    BodyForces load;

    SCREE_INLINE BodyGroup(const WideTables& tables, std::size_t first, const Indices& bodies, bool afresh) {
        KeptBodies& kept = reinterpret_cast<KeptBodies*>(tables.body_groups)[first / lanes];
        if (afresh) {
            properties = gather<BodyProperties>(tables.properties, bodies);
            load = gather<BodyForces>(tables.forces, bodies);
            kept = {load.acceleration,          properties.linear_damping, load.angular_acceleration, properties.angular_damping,
                    properties.inverse_inertia, properties.inverse_mass,   properties.motion};
            return;
        }
        load.acceleration = kept.acceleration;
        load.angular_acceleration = kept.angular_acceleration;
        properties.linear_damping = kept.linear_damping;
        properties.angular_damping = kept.angular_damping;
        properties.inverse_inertia = kept.inverse_inertia;
        properties.inverse_mass = kept.inverse_mass;
        properties.motion = kept.motion;
    }
};

void begin(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices bodies(listed(tables.items, first, last));
        const BodyGroup group(tables, first, bodies, tables.first);
        const VelocityDelta sum = sums_of_slots(tables, bodies);
        Velocity change;
        change.linear = sum.linear;
        change.angular = sum.angular;
        const Indices live = bodies.only(living(first, last));
        const Velocity velocity =
            integrate_velocity(gather<Velocity>(tables.velocities, bodies), change, group.load, group.properties, p);
        const Float shares = pack_shares(sum.weight, sum.passed_on);
        scatter(tables.velocities, live, velocity);
        scatter_member<BodyMass>(tables.masses, live, offsetof(BodyMass, shares), shares);
    }
}

void move(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices bodies(listed(tables.items, first, last));
        const BodyGroup group(tables, first, bodies, false);
        const VelocityDelta sum = sums_of_slots(tables, bodies);
        Velocity velocity = gather<Velocity>(tables.velocities, bodies);
        velocity.linear = velocity.linear + sum.linear;
        velocity.angular = velocity.angular + sum.angular;
        const Pose before = gather<Pose>(tables.poses, bodies);
        RigidState after = integrate(before, held_velocity(velocity, p), group.properties, p.h);
        const Indices live = bodies.only(living(first, last));
        const Bool sound = is_sound(after.pose) && is_sound(after.velocity);
        if (!none(!sound)) {
            scatter_member<Bounds>(tables.bounds, live.only(!sound), offsetof(Bounds, sweep.marks), UNSOUND);
            after = moved_soundly(sound, before, after);
        }
        if (tables.sums_impacts) scatter_member<BodyForces>(tables.forces, live, offsetof(BodyForces, impact_weight), sum.weight);
        if (!none(sum.weight > 0.0f))
            for (std::size_t lane = 0; lane < lanes && lane < last - first; ++lane)
                if (sum.weight.v[lane] > 0) tables.impact_debts[bodies.of[lane]] = sum.passed_on.v[lane];
        scatter(tables.poses, live, after.pose);
        scatter(tables.velocities, live, after.velocity);
        const Bool turns = !has_isotropic_inertia(group.properties);
        if (none(turns)) continue;
        const BodyMass mass = gather<BodyMass>(tables.masses, bodies);
        scatter(tables.masses, live.only(turns), turned_mass(mass, group.properties, after.pose.orientation));
    }
}

void finish(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices bodies(listed(tables.items, first, last)), live = bodies.only(living(first, last));
        const VelocityDelta sum = sums_of_slots(tables, bodies);
        Velocity velocity = gather<Velocity>(tables.velocities, bodies);
        velocity.linear = flush_tiny(velocity.linear + sum.linear);
        velocity.angular = flush_tiny(velocity.angular + sum.angular);
        const Bool limited = is_spin_limited(velocity, p);
        velocity = held_velocity(velocity, p);
        const Bool sound = is_sound(velocity);
        scatter(tables.velocities, live, velocity);
        const BodyProperties properties = gather<BodyProperties>(tables.properties, bodies);
        const Bool fast = was_fast(properties, gather<Bounds>(tables.bounds, bodies).sweep, gather<Pose>(tables.poses, bodies));
        set_marks(tables, first, last,
                  choose(sum.weight != 0.0f, Uint(reference::carries_contacts), Uint(0u)) |
                      choose(sound, Uint(0u), Uint(reference::is_unsound)) |
                      choose(limited, Uint(reference::is_spin_limited), Uint(0u)) |
                      choose(fast, Uint(reference::was_fast), Uint(0u)));
    }
}

}  // namespace

LAWS_END
