// Groups of unloaded contacts (contact_solver.h): between bodies that lie a little apart, a third of all in a wall. While nothing
// loads them a pass reads no masses and writes no slots. For compute/cpu/simd/simd_stages.cpp.
#pragma once

#include "compute/cpu/simd/contact_group.h"

LAWS_BEGIN

namespace {

template <typename Record>
SCREE_INLINE Words any_bits(const Record& record) {
    Words any{};
    for (std::size_t word = 0; word < sizeof(Record) / sizeof(Words); ++word) {
        AnyWords one;
        __builtin_memcpy(&one, reinterpret_cast<const AnyWords*>(&record) + word, sizeof one);
        any |= one;
    }
    return any;
}
// Whether no contact of a group has an impulse, and what has been written to its slots is zero.
SCREE_INLINE bool is_unloaded(Impulse impulse, const VelocityPair& share, Float weight) {
    if (!none(impulse.normal_sum != 0.0f || weight != 0.0f)) return false;
    impulse.separation = vec4(0.0f);
    impulse.slide_distance = 0.0f;
    impulse.center_offset = vec3(0.0f);
    const Words deltas =
        any_bits(share.a.linear) | any_bits(share.a.angular) | any_bits(share.b.linear) | any_bits(share.b.angular);
    return none(Uint(any_bits(impulse) | deltas) != Uint(0u));
}

SCREE_INLINE Bool are_sound(const VelocityPair& v) {
    return is_sound(v.a) && is_sound(v.b);
}

// The passes over an unloaded group, whose slots are zero: false, and nothing is done, if a contact may become loaded. Functions
// by themselves, since inlined they cost the passes over loaded groups a fifth (registers).
template <bool plain>
[[gnu::noinline]] bool solve_unloaded(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    const Kept& group = kept(tables, first);
    prefetch_next<plain>(tables, first, last, group.c);
    const VelocityPair v = velocities_of(tables, group.c);
    return none(!are_sound(v) || may_load_biased(group.c, group.impulse, v, p));
}
template <bool plain>
[[gnu::noinline]] bool relax_unloaded(const WideTables& tables, std::size_t first, std::size_t last) {
    Parameters p;
    broadcast(tables.parameters, p);
    Kept& group = kept(tables, first);
    prefetch_next<plain>(tables, first, last, group.c);
    const VelocityPair v = velocities_of(tables, group.c);
    const Impulse after = after_motion(group.c, group.impulse, v, p);
    if (!none(!are_sound(v) || may_load_relaxed(group.c, after, v, p))) return false;
    keep_motion(group, after);
    if (tables.last) give_back<plain>(tables, group, first, last);
    return true;
}

}  // namespace

LAWS_END
