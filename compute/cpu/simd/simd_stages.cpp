// Contact preparation and the solver for SCREE_LANES contacts at once. The build compiles this file once per vector width
// (compute/CMakeLists.txt); compute/cpu/simd/simd_dispatch.cpp picks the widest that the processor has.
#include "compute/cpu/simd/simd_stages.h"

#include <stddef.h>

// Defines the types of the laws, so before them.
#include "compute/cpu/simd/simd_types.h"

#include "shaders/physics/collide/collide_box_box.h"
#include "shaders/physics/collide/collide_box_plane.h"
#include "shaders/physics/collide/collide_capsule_box.h"
#include "shaders/physics/collide/collide_capsule_capsule.h"
#include "shaders/physics/collide/collide_capsule_plane.h"
#include "shaders/physics/collide/collide_sphere_box.h"
#include "shaders/physics/collide/collide_sphere_capsule.h"
#include "shaders/physics/collide/collide_sphere_plane.h"
#include "shaders/physics/collide/collide_sphere_sphere.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/solve/contact.h"
#include "shaders/physics/solve/contact_constraint.h"
#include "shaders/physics/solve/contact_solver.h"
#include "shaders/physics/solve/motion.h"
#include "shaders/physics/solve/persistence.h"
#include "shaders/physics/solve/scaled_mass.h"
#undef float
#undef bool

#include "compute/cpu/simd/contact_group.h"

LAWS_BEGIN

namespace {

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
        scatter(tables.masses, live,
                mass_with_scale_of(gather<BodyMass>(tables.masses, bodies), properties, pose.orientation));
        set_marks(tables, first, last, choose(will_sweep(properties, velocity, p), 1u, 0u));
    }
}

// A group of pairs whose contacts of the last step may persist.
struct PairGroup {
    Indices pairs;
    Bool live;
    Pair pair;
    Contact contact;  // of the last step

    SCREE_INLINE PairGroup(const WideTables& tables, std::size_t first, std::size_t last)
        : pairs(listed(tables.items, first, last)),
          live(living(first, last)),
          pair(gather<Pair>(tables.pairs, pairs)),
          contact(gather<Contact>(tables.contacts_before, Indices(pair.previous))) {}
};
SCREE_INLINE Uint body_of(Uint row, const BodyProperties& properties) {
    return choose(is_part(properties), properties.owner, row);
}

void keep(const WideTables& tables, std::size_t first, std::size_t last) {
    for (; first < last; first += lanes) {
        const PairGroup group(tables, first, last);
        const BodyProperties ta = gather<BodyProperties>(tables.properties, Indices(group.pair.a));
        const BodyProperties tb = gather<BodyProperties>(tables.properties, Indices(group.pair.b));
        const Indices a(body_of(group.pair.a, ta)), b(body_of(group.pair.b, tb));
        const Pose pose_a = gather<Pose>(tables.poses, a), pose_b = gather<Pose>(tables.poses, b);
        const Bool keeps = group.live && is_persistent(group.contact, ta, pose_a, gather<Velocity>(tables.velocities, a), tb,
                                                       pose_b, gather<Velocity>(tables.velocities, b));
        if (none(keeps)) continue;
        scatter(tables.manifolds, group.pairs.only(keeps), persistent_manifold(group.contact, pose_a, pose_b));
        constexpr std::size_t words = sizeof(Pair) / sizeof(Words), at = offsetof(Pair, pair_type) / sizeof(Words);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (keeps.v[lane] == 0) continue;
            tables.pairs[words * group.pairs.of[lane] + at] = PAIR_PERSISTENT.v[lane];
            tables.point_counts[group.pairs.of[lane]] = group.contact.count.v[lane];
        }
    }
}

// A group of pairs whose bodies, or parts, the narrowphase compares.
struct TouchingGroup {
    Indices pairs;
    Bool live;
    std::size_t count;
    Pair pair;
    BodyProperties ta, tb;
    Pose pose_a, pose_b;

    SCREE_INLINE TouchingGroup(const WideTables& tables, std::size_t first, std::size_t last)
        : pairs(listed(tables.items, first, last)),
          live(living(first, last)),
          count(last - first < lanes ? last - first : lanes),
          pair(gather<Pair>(tables.pairs, pairs)),
          ta(gather<BodyProperties>(tables.properties, Indices(pair.a))),
          tb(gather<BodyProperties>(tables.properties, Indices(pair.b))),
          pose_a(gather<Pose>(tables.poses, Indices(pair.a))),
          pose_b(gather<Pose>(tables.poses, Indices(pair.b))) {}

    SCREE_INLINE Margin margin(const WideTables& tables, const Parameters& p) const {
        return margin_of(ta, gather<Velocity>(tables.velocities, Indices(pair.a)), tb,
                         gather<Velocity>(tables.velocities, Indices(pair.b)), p);
    }
    SCREE_INLINE void keep(const WideTables& tables, const ManifoldBuffer& touch) const {
        scatter(tables.manifolds, pairs.only(live), touch.manifold);
        for (std::size_t lane = 0; lane < count; ++lane) tables.point_counts[pairs.of[lane]] = touch.count.v[lane];
    }
};

// Of each lane the record of one or the other.
template <typename Record>
SCREE_INLINE Record choose_record(Bool condition, const Record& a, const Record& b) {
    Record chosen;
    for (std::size_t word = 0; word < sizeof(Record) / sizeof(Words); ++word) {
        AnyWords of_a, of_b;
        __builtin_memcpy(&of_a, reinterpret_cast<const AnyWords*>(&a) + word, sizeof of_a);
        __builtin_memcpy(&of_b, reinterpret_cast<const AnyWords*>(&b) + word, sizeof of_b);
        reinterpret_cast<AnyWords*>(&chosen)[word] = condition.v ? of_a : of_b;
    }
    return chosen;
}

using CollisionLaw = ManifoldBuffer(BodyProperties, Pose, BodyProperties, Pose, Float);
template <CollisionLaw law>
SCREE_INLINE void collide_by(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const TouchingGroup group(tables, first, last);
        const Margin margin = group.margin(tables, p);
        const Bool swaps = group.ta.shape > group.tb.shape;  // laws expect the shape of the lower id first
        const Pose front = choose_record(swaps, group.pose_b, group.pose_a), back = choose_record(swaps, group.pose_a, group.pose_b);
        const ManifoldBuffer touch = law(choose_record(swaps, group.tb, group.ta), front,
                                         choose_record(swaps, group.ta, group.tb), back, greatest_margin(margin));
        group.keep(tables, within_margin(flipped(swaps, touch, back.position - front.position), margin));
    }
}
void collide(const WideTables& tables, std::uint32_t pair_type, std::size_t first, std::size_t last) {
    switch (pair_type) {
        case 0:
            return collide_by<collide_sphere_sphere>(tables, first, last);
        case 1:
            return collide_by<collide_sphere_capsule>(tables, first, last);
        case 2:
            return collide_by<collide_sphere_box>(tables, first, last);
        case 3:
            return collide_by<collide_sphere_plane>(tables, first, last);
        case 4:
            return collide_by<collide_capsule_capsule>(tables, first, last);
        case 5:
            return collide_by<collide_capsule_box>(tables, first, last);
        case 6:
            return collide_by<collide_capsule_plane>(tables, first, last);
        default:
            return collide_by<collide_box_plane>(tables, first, last);
    }
}

void separate_boxes(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const TouchingGroup group(tables, first, last);
        BoxPair found;
        found.margin = group.margin(tables, p);
        found.axes = box_axes(group.ta, group.pose_a, group.tb, group.pose_b, greatest_margin(found.margin));
        const Uint places = Uint(lane_numbers()) + Uint(static_cast<std::uint32_t>(first));
        scatter(tables.out, Indices(places).only(group.live), found);
    }
}

void collide_boxes(const WideTables& tables, std::size_t first, std::size_t last) {
    for (; first < last; first += lanes) {
        const TouchingGroup group(tables, first, last);
        const BoxPair found = gather<BoxPair>(tables.out, Indices(listed(tables.places, first, last)));
        const ManifoldBuffer touch = manifold_of_boxes(group.ta, group.pose_a, group.tb, group.pose_b, found.axes,
                                                       greatest_margin(found.margin));
        group.keep(tables, within_margin(touch, found.margin));
    }
}

// Writes a member of the first of the contacts, which is at that offset in a record of lanes.
SCREE_INLINE void set_in_contacts(const WideTables& tables, std::size_t offset, const Indices& contacts, Float value,
                                  std::size_t items) {
    constexpr std::size_t words = sizeof(Contact) / sizeof(Words);
    for (std::size_t lane = 0; lane < lanes && lane < items; ++lane) {
        const auto of_lane = value.v[lane];
        __builtin_memcpy(tables.contacts + words * contacts.of[lane] + offset / sizeof(Words), &of_lane, sizeof of_lane);
    }
}

// What a group of contacts has from the last step, and from the manifolds of this one.
struct Inherited {
    Impulse impulse;
    Float load, unrest;
    Uint slot_a, slot_b;
};
constexpr std::size_t words_of_impulse = sizeof(Impulse) / sizeof(Words);
constexpr std::uint32_t zero_impulse[words_of_impulse] = {};

SCREE_INLINE Inherited inherited(const WideTables& tables, const Indices& contacts, const BodyProperties& ta,
                                 const BodyProperties& tb, const Contact& contact) {
    Words pair_of, slot_a, slot_b;
    for (int lane = 0; lane < lanes; ++lane) {
        pair_of[lane] = tables.contact_pairs[contacts.of[lane]];
        slot_a[lane] = tables.contact_slots[2 * contacts.of[lane]];
        slot_b[lane] = tables.contact_slots[2 * contacts.of[lane] + 1];
    }
    const Indices pairs{Uint(pair_of)};
    const Pair pair = gather<Pair>(tables.pairs, pairs);
    const Bool known = pair.previous != Uint(NONE), carried = is_carried_forward(pair.pair_type), matched = known && !carried;
    const std::uint32_t* places[SCREE_LANES];
    for (int lane = 0; lane < lanes; ++lane)
        places[lane] = known.v[lane] != 0 ? tables.impulses_before + words_of_impulse * pair.previous.v[lane] : zero_impulse;
    const Impulse was = gather_at<Impulse>(places);
    Inherited found{no_impulse(contact.center_offset), contact.load, contact.unrest, slot_a, slot_b};
    found.impulse.separation = separations_of(contact);
    if (!none(carried)) {
        const Impulse now = carried_impulse(contact, was, gather<Manifold>(tables.manifolds, pairs));
        found.impulse = none(!carried) ? now : choose_record(carried, now, found.impulse);
        found.load = choose(carried, load_since(contact, was, ta, found.slot_a, tb, found.slot_b), contact.load);
    }
    if (!none(matched)) {
        const Contact before = gather<Contact>(tables.contacts_before, Indices(choose(matched, pair.previous, Uint(0u))));
        Impulse now = warm_start_from(contact, was, matches_of(contact, before, match_radius(contact, before, ta, tb)));
        now.separation = found.impulse.separation;
        found.impulse = choose_record(matched, now, found.impulse);
        found.load = choose(matched, load_since(before, was, ta, found.slot_a, tb, found.slot_b), found.load);
        found.unrest = choose(matched, before.unrest, found.unrest);
    }
    found.impulse.normal_sum = normal_impulse(found.impulse);
    return found;
}

void warm_start_and_prepare(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices contacts(listed(tables.items, first, last));
        Contact contact = gather<Contact>(tables.contacts, contacts);
        const BodyProperties ta = gather<BodyProperties>(tables.properties, Indices(contact.a));
        const BodyProperties tb = gather<BodyProperties>(tables.properties, Indices(contact.b));
        const Inherited from = inherited(tables, contacts, ta, tb, contact);
        contact.unrest = from.unrest;
        Constraint c =
            constraint_between(contact, ta, body_of(contact.a, ta), from.slot_a, tb, body_of(contact.b, tb), from.slot_b, p);
        const Indices a(c.a), b(c.b);
        const VelocityPair now{gather<Velocity>(tables.velocities, a), gather<Velocity>(tables.velocities, b)};
        const Float unrest = unrest_of(contact, c, ta, tb, now, p);
        c = with_unrest(c, unrest);
        const Bool live = living(first, last);
        scatter(tables.constraints, contacts.only(live), c);
        set_in_contacts(tables, offsetof(Contact, unrest), contacts, unrest, last - first);
        set_in_contacts(tables, offsetof(Contact, load), contacts, from.load, last - first);
        Kept& prepared = kept(tables, first);
        prepared.c = c;
        prepared.impulse = tables.plain ? narrowed<true>(from.impulse) : from.impulse;
        const Mass ma = split_mass(gather<BodyMass>(tables.masses, a), from.impulse, p);
        const Mass mb = split_mass(gather<BodyMass>(tables.masses, b), from.impulse, p);
        const Float weight = is_active(c, from.impulse, now, p);
        const VelocityPair share = to_body_deltas(now, now, ma, mb);
        to_slots(tables, live, c, warm_start(c, from.impulse, share, ma, mb), weight, from.impulse.normal_sum);
    }
}

void prepare(const WideTables& tables, std::size_t first, std::size_t last) {
    if (tables.warm_starts) return warm_start_and_prepare(tables, first, last);
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices contacts(listed(tables.items, first, last));
        const Contact contact = gather<Contact>(tables.contacts, contacts);
        Kept& prepared = kept(tables, first);
        prepared.c = gather<Constraint>(tables.constraints, contacts);
        prepared.impulse = gather<Impulse>(tables.impulses, contacts);
        const Bool waits = point_count(prepared.c) == 0u;
        if (!none(waits)) {
            const BodyProperties ta = gather<BodyProperties>(tables.properties, Indices(contact.a));
            const BodyProperties tb = gather<BodyProperties>(tables.properties, Indices(contact.b));
            const Constraint was = prepared.c;
            const VelocityPair now{gather<Velocity>(tables.velocities, Indices(was.a)),
                                   gather<Velocity>(tables.velocities, Indices(was.b))};
            Constraint c = constraint_between(contact, ta, was.a, was.slot_a, tb, was.b, was.slot_b, p);
            const Float unrest = unrest_of(contact, c, ta, tb, now, p);
            c = with_unrest(c, unrest);
            prepared.c = none(!waits) ? c : choose_record(waits, c, was);
            scatter(tables.constraints, contacts.only(living(first, last) && waits), c);
            constexpr std::size_t words = sizeof(Contact) / sizeof(Words), at = offsetof(Contact, unrest) / sizeof(Words);
            for (std::size_t lane = 0; lane < lanes && lane < last - first; ++lane)
                if (waits.v[lane] != 0) {
                    const auto of_lane = unrest.v[lane];
                    __builtin_memcpy(tables.contacts + words * contacts.of[lane] + at, &of_lane, sizeof of_lane);
                }
        }
        const Group<false> group(tables, first, last);
        const Mass ma = split_mass(gather<BodyMass>(tables.masses, group.a), group.impulse, p);
        const Mass mb = split_mass(gather<BodyMass>(tables.masses, group.b), group.impulse, p);
        const Float weight = is_active(group.c, group.impulse, group.before, p);
        const VelocityPair share = to_body_deltas(group.before, group.before, ma, mb);
        group.hand_out(tables, warm_start(group.c, group.impulse, share, ma, mb), weight, group.impulse.normal_sum);
        if (tables.plain) prepared.impulse = narrowed<true>(prepared.impulse);
    }
}

template <bool plain>
SCREE_INLINE void solve_groups(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        prefetch_next(tables, first, last);
        const Group<plain> group(tables, first, last);
        const Mass ma = split_mass(gather<BodyMass>(tables.masses, group.a), group.impulse, p);
        const Mass mb = split_mass(gather<BodyMass>(tables.masses, group.b), group.impulse, p);
        const SolveResult after =
            solve_contact(group.c, group.impulse, group.before, ma, mb, group.impacts_state(tables, p), 1.0f, p);
        const VelocityPair share = to_body_deltas(group.before, after.pair_velocity, ma, mb);
        group.keep_solved(after.impulse);
        if (tables.watched) group.give_back(tables, first, last);
        group.hand_out(tables, share, after.impulse.impact_weight, impact_debt(after.impulse));
    }
}
void solve(const WideTables& tables, std::size_t first, std::size_t last) {
    if (tables.plain)
        solve_groups<true>(tables, first, last);
    else
        solve_groups<false>(tables, first, last);
}

// physics::impact_mass, reading forces only if a lane has an impact.
SCREE_INLINE Mass shared(const Impulse& impulse, const WideTables& tables, const Indices& bodies, const Parameters& p) {
    const BodyMass mass = gather<BodyMass>(tables.masses, bodies);
    if (none(is_impact(impulse))) return split_mass(mass, impulse, p);
    return impact_mass(impulse, mass, gather<BodyForces>(tables.forces, bodies), p);
}

// physics::part_of_debts, likewise.
template <bool plain>
SCREE_INLINE Float debts(const WideTables& tables, const Group<plain>& group, const Mass& a, const Mass& b) {
    if (none(is_impact(group.impulse))) return 0.0f;
    Float of_a, of_b;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        of_a.v[lane] = tables.impact_debts[group.a.of[lane]];
        of_b.v[lane] = tables.impact_debts[group.b.of[lane]];
    }
    return part_of_debts(group.impulse, of_a, gather<BodyForces>(tables.forces, group.a), a, of_b,
                         gather<BodyForces>(tables.forces, group.b), b);
}

// Adds this substep's normal impulses to the contacts' sums over the step.
SCREE_INLINE void feel(const WideTables& tables, const Indices& contacts, const Impulse& impulse, std::size_t items) {
    const Float carried = solved_impulse(impulse);
    for (std::size_t lane = 0; lane < lanes && lane < items; ++lane) {
        float& sum = tables.carried[contacts.of[lane]];
        sum = tables.first ? carried.v[lane] : sum + carried.v[lane];
    }
}

template <bool plain>
SCREE_INLINE void relax_groups(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        prefetch_next(tables, first, last);
        const Group<plain> group(tables, first, last);
        const Impulse& was = group.impulse;
        const Mass ma = shared(was, tables, group.a, p), mb = shared(was, tables, group.b, p);
        const SolveResult after = relax_contact(group.c, was, group.before, group.before, ma, mb, group.impacts_state(tables, p),
                                                debts(tables, group, ma, mb), 1.0f, tables.last ? 1.0f : 0.0f, p);
        if (tables.carried != nullptr) feel(tables, Indices(listed(tables.items, first, last)), after.impulse, last - first);
        Impulse impulse = clear_impacts(after.impulse, point_count(group.c));
        impulse.normal_sum = normal_impulse(impulse);
        VelocityPair share = to_body_deltas(group.before, after.pair_velocity, ma, mb);
        const Float weight = counts_next(group.c, was, impulse, after.pair_velocity, ma, mb, p);
        if (!tables.last) share = warm_start(group.c, impulse, share, ma, mb);
        group.keep(impulse);
        if (tables.last || tables.watched) group.give_back(tables, first, last);
        group.hand_out(tables, share, weight, impulse.normal_sum);
    }
}
void relax(const WideTables& tables, std::size_t first, std::size_t last) {
    if (tables.plain)
        relax_groups<true>(tables, first, last);
    else
        relax_groups<false>(tables, first, last);
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

SCREE_INLINE Uint steps_of(const WideTables& tables, const Indices& bodies) {
    if (tables.ages == nullptr) return tables.steps;
    Words words;
    for (int lane = 0; lane < lanes; ++lane) words[lane] = tables.ages[bodies.of[lane]];
    return words;
}

void begin(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices bodies(listed(tables.items, first, last));
        const VelocityDelta sum = sums_of_slots(tables, bodies);
        const BodyProperties properties = gather<BodyProperties>(tables.properties, bodies);
        const BodyForces load = gather<BodyForces>(tables.forces, bodies);
        Velocity change, velocity = gather<Velocity>(tables.velocities, bodies);
        change.linear = sum.linear;
        change.angular = sum.angular;
        BodyMass mass = gather<BodyMass>(tables.masses, bodies);
        const Float scale = mass_scale(mass, properties);
        const Bool is_scaled = scale > 1.0f;
        if (!none(is_scaled)) {
            const ScaledChange scaled =
                with_acceleration(change, velocity, gather<ScaledMotion>(tables.scaled_motions, bodies), load, scale, p);
            change = scaled.change;
            scatter(tables.scaled_motions, bodies.only(living(first, last) && is_scaled), scaled.motion);
        }
        velocity = integrate_velocity(velocity, change, scaled_forces(load, scale), properties, p);
        Float& state = mass.split_state;
        if (tables.first) state = update_hysteresis(state, sum.weight, steps_of(tables, bodies));
        state = split_state_after(state, sum.weight, sum.normal_impulse);
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
        const VelocityDelta sum = sums_of_slots(tables, bodies);
        const BodyProperties properties = gather<BodyProperties>(tables.properties, bodies);
        BodyForces load = gather<BodyForces>(tables.forces, bodies);
        Velocity velocity = gather<Velocity>(tables.velocities, bodies);
        velocity.linear = velocity.linear + sum.linear;
        velocity.angular = velocity.angular + sum.angular;
        load.impacts = impacts_of(sum.weight, properties);
        const Pose before = gather<Pose>(tables.poses, bodies);
        RigidState after = integrate(before, velocity, properties, p.h);
        const Bool sound = is_sound(after.pose) && is_sound(after.velocity);
        if (!none(!sound)) {
            load.kept = choose(sound, load.kept, Float(UNSOUND));
            after = moved_soundly(sound, before, after);
        }
        const Indices live = bodies.only(living(first, last));
        for (std::size_t lane = 0; lane < lanes && lane < last - first; ++lane)
            if (sum.weight.v[lane] > 0) tables.impact_debts[bodies.of[lane]] = sum.normal_impulse.v[lane];
        scatter(tables.forces, live, load);
        scatter(tables.poses, live, after.pose);
        scatter(tables.velocities, live, after.velocity);
        if (none(!has_isotropic_inertia(properties))) continue;
        const BodyMass mass = gather<BodyMass>(tables.masses, bodies);
        scatter(tables.masses, bodies.only(living(first, last) && !has_isotropic_inertia(properties)),
                mass_with_scale_of(mass, properties, after.pose.orientation));
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
        const Bool sound = is_sound(velocity), limited = is_spin_limited(velocity, p);
        velocity = held_velocity(velocity, p);
        scatter(tables.velocities, live, velocity);
        const BodyProperties properties = gather<BodyProperties>(tables.properties, bodies);
        const Bool fast =
            was_fast(properties, gather<Bounds>(tables.bounds, bodies).sweep, gather<Pose>(tables.poses, bodies));
        set_marks(tables, first, last,
                  choose(sum.weight != 0.0f, Uint(reference::carries_contacts), Uint(0u)) |
                      choose(sound, Uint(0u), Uint(reference::is_unsound)) |
                      choose(limited, Uint(reference::is_spin_limited), Uint(0u)) |
                      choose(fast, Uint(reference::was_fast), Uint(0u)));
    }
}

}  // namespace

LAWS_END

namespace scree::reference {

#define SCREE_STAGES(count) SCREE_JOINED(wide_stages_, count)
const WideStages SCREE_STAGES(SCREE_LANES) = {SCREE_LANES,
                                              SCREE_NAMED(SCREE_LANES)::bound,
                                              SCREE_NAMED(SCREE_LANES)::keep,
                                              SCREE_NAMED(SCREE_LANES)::collide,
                                              SCREE_NAMED(SCREE_LANES)::separate_boxes,
                                              SCREE_NAMED(SCREE_LANES)::collide_boxes,
                                              SCREE_NAMED(SCREE_LANES)::prepare,
                                              SCREE_NAMED(SCREE_LANES)::begin,
                                              SCREE_NAMED(SCREE_LANES)::solve,
                                              SCREE_NAMED(SCREE_LANES)::move,
                                              SCREE_NAMED(SCREE_LANES)::relax,
                                              SCREE_NAMED(SCREE_LANES)::finish};

}  // namespace scree::reference
