// The stage of cohesion over contacts in lanes. For compute/cpu/simd/simd_stages.cpp.
#pragma once

#include "compute/cpu/simd/contact_group.h"

LAWS_BEGIN

namespace {

SCREE_INLINE void add_to_slots(const WideTables& tables, Uint slot, Bool live, const Velocity& change) {
    const Bool moves = live && slot != Uint(NONE);
    const VelocityDelta before = gather<VelocityDelta>(tables.slots, Indices(choose(moves, slot, Uint(0u))));
    scatter(tables.slots, Indices(slot).only(moves), with_change(before, change));
}

void attract(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    for (; first < last; first += lanes) {
        const Indices contacts(listed(tables.items, first, last));
        Float force, points;
        for (int lane = 0; lane < lanes; ++lane) {
            force.v[lane] = tables.attractions[2 * contacts.of[lane]];
            points.v[lane] = tables.attractions[2 * contacts.of[lane] + 1];
        }
        const Bool acts = living(first, last) && force > 0.0f;
        if (none(acts)) continue;
        const Kept& group = kept(tables, first);
        const Mass a = whole_mass(gather<BodyMass>(tables.masses, Indices(group.c.a)));
        const Mass b = whole_mass(gather<BodyMass>(tables.masses, Indices(group.c.b)));
        const VelocityPair change =
            changes_by_attraction(group.c, group.impulse.center_offset, Attraction{force, Uint(points)}, a, b, p);
        add_to_slots(tables, group.c.slot_a, acts, change.a);
        add_to_slots(tables, group.c.slot_b, acts, change.b);
        tables.unloaded[first / lanes] = 0;
    }
}

}  // namespace

LAWS_END
