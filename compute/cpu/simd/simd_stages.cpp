// The laws of the solver for SCREE_LANES contacts at once. The build compiles this file once for each kind of vectors
// (compute/CMakeLists.txt), and compute/cpu/simd/simd_dispatch.cpp picks the widest that the processor has.
#include "compute/cpu/simd/simd_stages.h"

// Says what the words of the laws mean, so before them.
#include "compute/cpu/simd/simd_types.h"

// The laws.
#include "shaders/physics/solve/contact_solver.h"
#include "shaders/physics/solve/motion.h"
#undef float
#undef bool

LAWS_BEGIN

namespace {

using reference::WideTables;

SCREE_INLINE Words lane_numbers() {
    Words numbers;
    for (int lane = 0; lane < lanes; ++lane) numbers[lane] = static_cast<std::uint32_t>(lane);
    return numbers;
}
// The next items; lanes beyond the end have the last one.
SCREE_INLINE Uint listed(const std::uint32_t* items, std::size_t first, std::size_t last) {
    Words found;
    if (last - first >= lanes) {
        __builtin_memcpy(&found, items + first, sizeof found);
    } else {
        for (int lane = 0; lane < lanes; ++lane) {
            const std::size_t item = first + static_cast<std::size_t>(lane);
            found[lane] = items[item < last ? item : last - 1];
        }
    }
    return found;
}
SCREE_INLINE Bool living(std::size_t first, std::size_t last) {
    return Uint(lane_numbers()) < Uint(static_cast<std::uint32_t>(last - first < lanes ? last - first : lanes));
}

// A group of contacts: which, and what the solver knows of them and their bodies.
struct Group {
    Indices contacts;
    Bool live;  // not those beyond the end, which see the last contact again
    Constraint c;
    Impulse impulse;
    Indices a, b;
    Couple before;

    SCREE_INLINE Group(const WideTables& tables, std::size_t first, std::size_t last)
        : contacts(listed(tables.items, first, last)),
          live(living(first, last)),
          c(gather<Constraint>(tables.constraints, contacts)),
          impulse(gather<Impulse>(tables.impulses, contacts)),
          a(c.a),
          b(c.b),
          before{gather<Velocity>(tables.velocities, a), gather<Velocity>(tables.velocities, b)} {}

    SCREE_INLINE vec3 pull(const WideTables& tables) const {
        if (none(c.restitution > 0.0f)) return vec3(0.0f);
        return choose(c.restitution > 0.0f, pull_of(gather<Load>(tables.loads, a), gather<Load>(tables.loads, b)), vec3(0.0f));
    }
    SCREE_INLINE void hand_out(const WideTables& tables, const Impulse& after, const Couple& share, Float carrying, Float told_a,
                               Float told_b) const {
        scatter(tables.impulses, contacts.only(live), after);
        hand_out(tables, share, carrying, told_a, told_b);
    }
    SCREE_INLINE void hand_out(const WideTables& tables, const Couple& share, Float carrying, Float told_a, Float told_b) const {
        scatter(tables.slots, Indices(choose(live, c.slot_a, Uint(NONE))), slot_of(share.a, carrying, told_b));
        scatter(tables.slots, Indices(choose(live, c.slot_b, Uint(NONE))), slot_of(share.b, carrying, told_a));
    }
};

void hand_out(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Group group(tables, first, last);
        const Mass ma = lent(gather<Mass>(tables.masses, group.a), group.impulse, p);
        const Mass mb = lent(gather<Mass>(tables.masses, group.b), group.impulse, p);
        const Float carrying = carries(group.c, group.impulse, group.before, p);
        const Couple share = shares_of(group.before, group.before, ma, mb);
        group.hand_out(tables, warm_start(group.c, group.impulse, share, ma, mb), carrying, group.impulse.pressed,
                       group.impulse.pressed);
    }
}

void solve(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Group group(tables, first, last);
        const Mass ma = lent(gather<Mass>(tables.masses, group.a), group.impulse, p);
        const Mass mb = lent(gather<Mass>(tables.masses, group.b), group.impulse, p);
        const Solved after = solved(group.c, group.impulse, group.before, ma, mb, group.pull(tables), p);
        const Couple share = shares_of(group.before, after.couple, ma, mb);
        group.hand_out(tables, after.impulse, share, blow_of(after.impulse), 0.0f, 0.0f);
    }
}

SCREE_INLINE Float told_by(const std::uint32_t* told, const Indices& bodies) {
    Words words;
    for (int lane = 0; lane < lanes; ++lane) words[lane] = told[bodies.of[lane]];
    return uintBitsToFloat(words);
}

// physics::shared_for, which asks for a load only where there is a blow.
SCREE_INLINE Mass shared(const Impulse& impulse, const WideTables& tables, const Indices& bodies, const Parameters& p) {
    const Mass mass = gather<Mass>(tables.masses, bodies);
    if (none(blow_of(impulse) > 0.0f)) return lent(mass, impulse, p);
    return shared_for(impulse, mass, gather<Load>(tables.loads, bodies), p);
}

// What the contacts carry in this substep, added to what they carried in those before.
SCREE_INLINE void feel(const WideTables& tables, const Group& group, const Impulse& impulse, std::size_t items) {
    const Float carried = pressing(impulse);
    for (std::size_t lane = 0; lane < lanes && lane < items; ++lane) {
        float& sum = tables.carried[group.contacts.of[lane]];
        sum = tables.first ? carried.v[lane] : sum + carried.v[lane];
    }
}

void relax(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Group group(tables, first, last);
        const Impulse& was = group.impulse;
        const Mass ma = shared(was, tables, group.a, p), mb = shared(was, tables, group.b, p);
        const Solved after = relaxed(group.c, was, group.before, ma, mb, group.pull(tables), p);
        if (tables.carried != nullptr) feel(tables, group, after.impulse, last - first);
        Impulse impulse = without_blows(after.impulse, group.c.count);
        impulse.pressed = pressing(impulse);
        Couple share = shares_of(group.before, after.couple, ma, mb);
        const Float carrying = carries(group.c, impulse, after.couple, p);
        Float told_a = impulse.pressed, told_b = impulse.pressed;
        if (tables.told == nullptr) {
            share = warm_start(group.c, impulse, share, ma, mb);
        } else {
            told_a = told_by(tables.told, group.a);
            told_b = told_by(tables.told, group.b);
        }
        group.hand_out(tables, impulse, share, carrying, told_a, told_b);
    }
}

// What the contacts did to each body: the sums over its slots, in their order. A slot is eight floats, added side by side.
SCREE_INLINE Slot sums_of_slots(const WideTables& tables, const Indices& bodies) {
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
    return gather<Slot>(sums, Indices(lane_numbers()));
}

void begin(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices bodies(listed(tables.items, first, last));
        const Slot sum = sums_of_slots(tables, bodies);
        const Traits traits = gather<Traits>(tables.traits, bodies);
        const Load load = gather<Load>(tables.loads, bodies);
        Velocity change, velocity = gather<Velocity>(tables.velocities, bodies);
        change.linear = sum.linear;
        change.angular = sum.angular;
        velocity = accelerated(velocity, change, load, traits, p);
        Mass mass = gather<Mass>(tables.masses, bodies);
        if (tables.first) mass.split = drifted(mass.split, sum.carries, tables.steps);
        mass.split = crowd_after(mass.split, sum.carries, sum.told);
        const Indices live = bodies.only(living(first, last));
        scatter(tables.velocities, live, velocity);
        scatter(tables.masses, live, mass);
    }
}

void move(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices bodies(listed(tables.items, first, last));
        const Slot sum = sums_of_slots(tables, bodies);
        const Traits traits = gather<Traits>(tables.traits, bodies);
        Load load = gather<Load>(tables.loads, bodies);
        Velocity velocity = gather<Velocity>(tables.velocities, bodies);
        velocity.linear = velocity.linear + sum.linear;
        velocity.angular = velocity.angular + sum.angular;
        load.blows = sum.carries;
        const Moved after = moved(gather<Pose>(tables.poses, bodies), velocity, traits, p.h);
        const Indices live = bodies.only(living(first, last));
        scatter(tables.loads, live, load);
        scatter(tables.poses, live, after.pose);
        scatter(tables.velocities, live, after.velocity);
        if (none(!turns_evenly(traits))) continue;
        const Mass mass = gather<Mass>(tables.masses, bodies);
        scatter(tables.masses, bodies.only(living(first, last) && !turns_evenly(traits)),
                mass_in_world(traits, after.pose.orientation, mass.split));
    }
}

}  // namespace

LAWS_END

namespace scree::reference {

#define SCREE_STAGES(count) SCREE_JOINED(wide_stages_, count)
const WideStages SCREE_STAGES(SCREE_LANES) = {SCREE_NAMED(SCREE_LANES)::hand_out, SCREE_NAMED(SCREE_LANES)::begin,
                                              SCREE_NAMED(SCREE_LANES)::solve, SCREE_NAMED(SCREE_LANES)::move,
                                              SCREE_NAMED(SCREE_LANES)::relax};

}  // namespace scree::reference
