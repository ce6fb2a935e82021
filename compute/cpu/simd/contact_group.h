// A group of contacts in lanes: what the passes of a step keep of it, and the bodies it reads and writes. For
// compute/cpu/simd/simd_stages.cpp, after the laws.
#pragma once

#include "compute/cpu/simd/lane_items.h"

LAWS_BEGIN

namespace {

// What the passes of a step keep of a group of contacts.
struct Kept {
    Constraint c;
    Impulse impulse;
};
SCREE_INLINE Kept& kept(const WideTables& tables, std::size_t first) {
    return reinterpret_cast<Kept*>(tables.groups)[first / lanes];
}
// Prefetches the lines that the passes read of the next group, which in large worlds lies beyond the second cache. The next group
// is taken to have as many points as this one, as most have; the radii of round contacts are left out.
template <bool plain>
SCREE_INLINE void prefetch_next(const WideTables& tables, std::size_t first, std::size_t last, const Constraint& now) {
    if (!tables.prefetches || last - first <= lanes) return;
    const Kept& next = kept(tables, first + lanes);
    const auto fetch = [](const auto& from, const auto& to) {
        const char* const end = reinterpret_cast<const char*>(&to + 1);
        for (const char* line = reinterpret_cast<const char*>(&from); line < end; line += 64) __builtin_prefetch(line);
    };
    const auto fetch_points = [&](const vec4& of) {
        fetch(of.x, of.x);
        if (!none(point_count(now) > 1u)) fetch(of.y, of.y);
        if (!none(point_count(now) > 2u)) fetch(of.z, of.w);
    };
    fetch(next.c.a, next.c.friction);
    fetch_points(next.c.points_u);
    fetch_points(next.c.points_v);
    if (!plain) fetch(next.c.drive1, next.c.restitution_threshold);
    fetch(next.c.centre, next.c.twist_arm);
    if (!plain) fetch(next.c.rolling_resistance, next.c.restitution);
    fetch(next.c.flags, next.c.flags);
    if (!plain) fetch(next.c.tyre_slip, next.c.tyre_slip);
    fetch(next.c.slide_limit, next.c.slide_limit);
    fetch_points(next.impulse.normal);
    fetch_points(next.impulse.separation);
    if (!plain) fetch(next.impulse.impact, next.impulse.flight_energy);
    fetch(next.impulse.friction, next.impulse.turn);
}

// Specialisation by the features of a scene, as for devices (shaders/stages/lib/features.glsl): the compiler removes the
// code of what is constant. Replaces only members that are compared, or keep the sign of a zero.
template <bool plain>
SCREE_INLINE Constraint narrowed(Constraint c) {
    c.flags = c.flags & ~(CONSTRAINT_FOLLOWS | CONSTRAINT_LEADS);  // lanes take single contacts
    if (!plain) return c;
    c.restitution = c.rolling_resistance = c.tyre_slip = 0.0f;
    c.drive1 = c.drive2 = c.static_friction = c.restitution_threshold = 0.0f;
    return c;
}
SCREE_INLINE void narrow(Impulse& impulse) {
    impulse.impact = vec4(0.0f);
    impulse.rebound_energy = impulse.impact_energy = impulse.impact_weight = impulse.flight_energy = 0.0f;
    impulse.speed_before_push = impulse.response = 0.0f;
}
template <bool plain>
SCREE_INLINE Impulse narrowed(Impulse impulse) {
    if (plain) narrow(impulse);
    return impulse;
}

SCREE_INLINE void to_slots(const WideTables& tables, Bool live, const Constraint& c, const VelocityPair& share, Float weight,
                           Float passed_on) {
    scatter(tables.slots, Indices(choose(live, c.slot_a, Uint(NONE))), velocity_delta(share.a, weight, passed_on));
    scatter(tables.slots, Indices(choose(live, c.slot_b, Uint(NONE))), velocity_delta(share.b, weight, passed_on));
}

// What the motion of a substep changes (after_motion).
SCREE_INLINE void keep_motion(Kept& group, const Impulse& after) {
    group.impulse.separation = after.separation;
    group.impulse.slide_distance = after.slide_distance;
    group.impulse.center_offset = after.center_offset;
}
// The tables of impulses and impacts from what is kept.
template <bool plain>
SCREE_INLINE void give_back(const WideTables& tables, const Kept& group, std::size_t first, std::size_t last) {
    const Indices contacts = Indices(listed(tables.items, first, last)).only(living(first, last));
    scatter(tables.impulses, contacts, contact_impulse_of(group.impulse));
    if (!plain && tables.impacts != nullptr) scatter(tables.impacts, contacts, contact_impact_of(group.impulse));
}

SCREE_INLINE VelocityPair velocities_of(const WideTables& tables, const Constraint& c) {
    VelocityPair v{gather<Velocity>(tables.velocities, Indices(c.a)), gather<Velocity>(tables.velocities, Indices(c.b))};
    if (!tables.periodic) return v;
    Parameters p;
    broadcast(tables.parameters, p);
    v.b = at_image(v.b, image_in(c, p));
    return v;
}

// A group of contacts, one per lane, with solver data and bodies.
template <bool plain>
struct Group {
    Kept& record;
    Bool live;  // false in lanes beyond the end
    Constraint c;
    Impulse impulse;
    Indices a, b;
    VelocityPair before;

    SCREE_INLINE Group(const WideTables& tables, std::size_t first, std::size_t last)
        : record(kept(tables, first)),
          live(living(first, last)),
          c(narrowed<plain>(record.c)),
          impulse(narrowed<plain>(record.impulse)),
          a(c.a),
          b(c.b),
          before{velocities_of(tables, c)} {}

    SCREE_INLINE ImpactContext around_impact(const WideTables& tables, const Parameters& p) const {
        if (none(c.restitution > 0.0f)) return no_impact_context();
        return choose_record(c.restitution > 0.0f,
                             impact_context(c, gather<BodyForces>(tables.forces, a), gather<BodyForces>(tables.forces, b),
                                            gather<BodyMass>(tables.masses, a), gather<BodyMass>(tables.masses, b), p),
                             no_impact_context());
    }
    SCREE_INLINE void write_deltas(const WideTables& tables, const VelocityPair& share, Float weight, Float passed_on) const {
        to_slots(tables, live, c, share, weight, passed_on);
    }
    // What the biased pass changes, and what both do: fields that stay are not written.
    SCREE_INLINE void keep_solved(const Impulse& after) const {
        record.impulse.normal = after.normal;
        record.impulse.friction = after.friction;
        record.impulse.twist = after.twist;
        record.impulse.rolling = after.rolling;
        record.impulse.stretch = after.stretch;
        record.impulse.turn = after.turn;
        if (plain) return;
        record.impulse.impact = after.impact;
        record.impulse.rebound_energy = after.rebound_energy;
        record.impulse.impact_energy = after.impact_energy;
        record.impulse.impact_weight = after.impact_weight;
        record.impulse.flight_energy = after.flight_energy;
        record.impulse.speed_before_push = after.speed_before_push;
        record.impulse.response = after.response;
    }
    SCREE_INLINE void keep(const Impulse& after) const {
        keep_solved(after);
        keep_motion(record, after);
        record.impulse.normal_sum = after.normal_sum;
    }
};

}  // namespace

LAWS_END
