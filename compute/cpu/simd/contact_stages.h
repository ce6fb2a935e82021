// Stages over contacts, one per lane: their preparation with the warm start from the last step, and the two passes of a substep.
// For compute/cpu/simd/simd_stages.cpp.
#pragma once

#include "compute/cpu/simd/unloaded_group.h"

LAWS_BEGIN

namespace {

// What a group of contacts has from the last step, and from the manifolds of this one.
struct Inherited {
    Impulse impulse;
    Float load;
    Uint slot_a, slot_b;
};
constexpr std::size_t words_of_impulse = sizeof(ContactImpulse) / sizeof(Words);
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
    const Impulse was = whole_impulse(gather_at<ContactImpulse>(places), no_impact());
    Inherited found{no_impulse(contact.center_offset), contact.load, slot_a, slot_b};
    found.impulse.separation = separations_of(contact);
    if (!none(carried)) {
        const Impulse now = carried_impulse(contact, was, gather<Manifold>(tables.manifolds, pairs));
        found.impulse = none(!carried) ? now : choose_record(carried, now, found.impulse);
        found.load = choose(carried, load_since(contact, was, ta, found.slot_a, tb, found.slot_b), contact.load);
    }
    if (!none(matched)) {
        const Contact before = gather<Contact>(tables.contacts_before, Indices(choose(matched, pair.previous, Uint(0u))));
        Impulse now = warm_start_from(contact, was, matches_of(contact, before, match_radius(contact, before, ta, tb)),
                                      keeps_twist(before, ta, tb));
        now.separation = found.impulse.separation;
        found.impulse = choose_record(matched, now, found.impulse);
        found.load = choose(matched, load_since(before, was, ta, found.slot_a, tb, found.slot_b), found.load);
    }
    found.impulse.normal_sum = normal_impulse(found.impulse);
    return found;
}

// The joints of bodies.
SCREE_INLINE Uint joints_of(const WideTables& tables, const Indices& bodies) {
    constexpr std::size_t words_of_record = sizeof(BodyProperties) / sizeof(Words);
    constexpr std::size_t place = offsetof(BodyProperties, joints) / sizeof(Words);
    Words joints;
    for (int lane = 0; lane < lanes; ++lane) joints[lane] = tables.properties[words_of_record * bodies.of[lane] + place];
    return Uint(joints);
}

// Prefetches what preparation reads of the next group of contacts; of parts it is their own rows, not their bodies'.
SCREE_INLINE void prefetch_inherited(const WideTables& tables, std::size_t first, std::size_t last) {
    if (last < first + lanes) return;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::uint32_t contact = tables.items[first + lane], pair = tables.contact_pairs[contact];
        const PairWords words(tables, pair);
        prefetch<Contact>(tables.contacts, contact);
        if (words.previous != nowhere) prefetch<ContactImpulse>(tables.impulses_before, words.previous);
        if (words.pair_type == PAIR_PERSISTENT.v[0])
            prefetch<Manifold>(tables.manifolds, pair);
        else if (words.previous != nowhere)
            prefetch<Contact>(tables.contacts_before, words.previous);
        if (!tables.prefetches) continue;
        for (const std::uint32_t row : words.rows) {
            prefetch<BodyProperties>(tables.properties, row);
            prefetch<BodyMass>(tables.masses, row);
            prefetch<Velocity>(tables.velocities, row);
        }
    }
}

void warm_start_and_prepare(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        prefetch_inherited(tables, first + lanes, last);
        const Indices contacts(listed(tables.items, first, last));
        Contact contact = gather<Contact>(tables.contacts, contacts);
        const BodyProperties ta = gather<BodyProperties>(tables.properties, Indices(contact.a));
        const BodyProperties tb = gather<BodyProperties>(tables.properties, Indices(contact.b));
        const Inherited from = inherited(tables, contacts, ta, tb, contact);
        Constraint c =
            constraint_between(contact, ta, body_of(contact.a, ta), from.slot_a, tb, body_of(contact.b, tb), from.slot_b, p);
        const Indices a(c.a), b(c.b);
        c = with_joints(c, joints_of(tables, a), joints_of(tables, b));
        if (tables.periodic) c = meeting_image(c, image_met(tables, ta, a, tb, b, p));
        const VelocityPair now = velocities_of(tables, c);
        const Bool live = living(first, last);
        const Indices written = contacts.only(live);
        if (tables.constraints != nullptr) scatter(tables.constraints, written, c);
        scatter_member<Contact>(tables.contacts, written, offsetof(Contact, load), from.load);
        Kept& prepared = kept(tables, first);
        copy_record(prepared.c, c);
        copy_record(prepared.impulse, from.impulse);
        if (tables.plain) narrow(prepared.impulse);
        const Mass ma = whole_mass(gather<BodyMass>(tables.masses, a)), mb = whole_mass(gather<BodyMass>(tables.masses, b));
        const Float weight = is_active(c, from.impulse, now, p);
        const VelocityPair share = warm_start(c, from.impulse, ma, mb);
        to_slots(tables, live, c, share, weight, from.impulse.normal_sum);
        tables.unloaded[first / lanes] = is_unloaded(prepared.impulse, share, weight);
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
        prepared.impulse =
            whole_impulse(gather<ContactImpulse>(tables.impulses, contacts),
                          tables.impacts != nullptr ? gather<ContactImpact>(tables.impacts, contacts) : no_impact());
        const Bool waits = point_count(prepared.c) == 0u;
        if (!none(waits)) {
            const BodyProperties ta = gather<BodyProperties>(tables.properties, Indices(contact.a));
            const BodyProperties tb = gather<BodyProperties>(tables.properties, Indices(contact.b));
            const Constraint was = prepared.c;
            Constraint c = constraint_between(contact, ta, was.a, was.slot_a, tb, was.b, was.slot_b, p);
            c = with_joints(c, joints_of(tables, Indices(was.a)), joints_of(tables, Indices(was.b)));
            if (tables.periodic) c = meeting_image(c, image_met(tables, ta, Indices(was.a), tb, Indices(was.b), p));
            prepared.c = none(!waits) ? c : choose_record(waits, c, was);
            scatter(tables.constraints, contacts.only(living(first, last) && waits), c);
        }
        const Group<false> group(tables, first, last);
        const Mass ma = whole_mass(gather<BodyMass>(tables.masses, group.a));
        const Mass mb = whole_mass(gather<BodyMass>(tables.masses, group.b));
        const Float weight = is_active(group.c, group.impulse, group.before, p);
        const VelocityPair share = warm_start(group.c, group.impulse, ma, mb);
        group.write_deltas(tables, share, weight, group.impulse.normal_sum);
        if (tables.plain) narrow(prepared.impulse);
        tables.unloaded[first / lanes] = is_unloaded(prepared.impulse, share, weight);
    }
}

template <bool plain>
SCREE_INLINE void solve_groups(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        std::uint8_t& unloaded = tables.unloaded[first / lanes];
        if (unloaded != 0 && !tables.watched && solve_unloaded<plain>(tables, first, last)) continue;
        unloaded = 0;
        const Group<plain> group(tables, first, last);
        prefetch_next<plain>(tables, first, last, group.c);
        const BlockBodies bodies{split_mass(gather<BodyMass>(tables.masses, group.a), group.impulse, p),
                                 split_mass(gather<BodyMass>(tables.masses, group.b), group.impulse, p), group.before, 1.0f};
        const BiasedOutcome after = biased_pass(group.c, group.impulse, group.before, bodies, group.around_impact(tables, p), p);
        group.keep_solved(after.impulse);
        if (tables.watched) give_back<plain>(tables, group.record, first, last);
        group.write_deltas(tables, after.share, after.impact_weight, after.debt);
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
SCREE_INLINE void feel(const WideTables& tables, const Indices& contacts, Float borne, std::size_t items) {
    for (std::size_t lane = 0; lane < lanes && lane < items; ++lane) {
        float& sum = tables.carried[contacts.of[lane]];
        sum = tables.first ? borne.v[lane] : sum + borne.v[lane];
    }
}

template <bool plain>
SCREE_INLINE void relax_groups(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        std::uint8_t& unloaded = tables.unloaded[first / lanes];
        if (unloaded != 0 && !tables.watched && tables.carried == nullptr && relax_unloaded<plain>(tables, first, last)) continue;
        const Group<plain> group(tables, first, last);
        prefetch_next<plain>(tables, first, last, group.c);
        const BlockBodies bodies{shared(group.impulse, tables, group.a, p), shared(group.impulse, tables, group.b, p),
                                 group.before, 1.0f};
        ImpactContext around = group.around_impact(tables, p);
        around.debt = debts(tables, group, bodies.a, bodies.b);
        const RelaxOutcome after = relax_pass(group.c, group.impulse, group.before, bodies, around, tables.last, p);
        if (tables.carried != nullptr) feel(tables, Indices(listed(tables.items, first, last)), after.borne, last - first);
        group.keep(after.impulse);
        if (tables.last || tables.watched) give_back<plain>(tables, group.record, first, last);
        group.write_deltas(tables, after.share, after.counts, after.normal_sum);
        unloaded = is_unloaded(after.impulse, after.share, after.counts);
    }
}
void relax(const WideTables& tables, std::size_t first, std::size_t last) {
    if (tables.plain)
        relax_groups<true>(tables, first, last);
    else
        relax_groups<false>(tables, first, last);
}

}  // namespace

LAWS_END
