// Indirect dispatch sizes from counts, and overflow of the list buffers.
//
// A list that would outgrow its buffer is known from its count, before anything is written. All later stages then do
// nothing, the bodies stay as they were, and the host grows the buffer and repeats the step: no contact is ever
// dropped.
#ifndef SCREE_PHYSICS_WORK_COUNTS_H
#define SCREE_PHYSICS_WORK_COUNTS_H

#include "shaders/physics/base/records.h"

LAWS_BEGIN

// Workgroups of a dispatch (x, y, z) and its threads. More groups than one axis has room for are laid out in rows along the
// second, with fewer spare ones than rows (thread() and group() in shaders/stages/lib/stage.glsl number them).
LAW uvec4 work_of_groups(uint groups, uint threads, Parameters parameters) {
    uint along = groups, rows = 1u;
    for (; along > parameters.most_groups; rows = rows << 1) along = (along + 1u) >> 1;
    return uvec4(along, rows, 1u, threads);
}
LAW uvec4 work_for(uint threads, Parameters parameters) {
    return work_of_groups((threads + parameters.group_size - 1u) >> parameters.group_shift, threads, parameters);
}
// Blocks of a scan over `items` and the total behind them, and its dispatch.
LAW uint scan_blocks_of(uint items, Parameters parameters) {
    uint block = parameters.group_size << SCAN_SHIFT;
    return (items + block) >> (parameters.group_shift + SCAN_SHIFT);
}
LAW uvec4 scan_work_for(uint items, Parameters parameters) {
    return work_of_groups(scan_blocks_of(items, parameters), items + 1u, parameters);
}
// Buckets of the grid and of large bodies.
LAW uint buckets_in_all(Parameters parameters) {
    return parameters.buckets + parameters.copies;
}
LAW uint pair_blocks_of(uint pairs) {
    return (pairs + PAIR_BLOCK - 1u) >> PAIR_BLOCK_SHIFT;
}

// The dispatches that follow from the number of pairs.
LAW Counts with_pairs(Counts counts, uint total, Parameters parameters) {
    bool uncountable = counts.pairs_coarse > 0x800000u + parameters.bodies;  // 2^31 pairs: an error on the host
    if (total > parameters.pair_capacity || uncountable) {
        counts.overflow = counts.overflow | OVERFLOW_PAIRS;
        counts.required_pairs = uncountable ? 0xFFFFFFFFu : total;
    }
    counts.pairs = counts.overflow == 0u ? total : 0u;
    counts.arguments[WORK_PAIRS] = work_for(counts.pairs, parameters);
    counts.arguments[WORK_PAIR_BLOCKS] = work_for(pair_blocks_of(counts.pairs), parameters);
    counts.arguments[WORK_PAIR_TYPE_SCAN_BLOCKS] = scan_work_for(PAIR_TYPES * pair_blocks_of(counts.pairs), parameters);
    counts.arguments[WORK_PAIR_SCAN_BLOCKS] = scan_work_for(counts.pairs, parameters);
    counts.arguments[WORK_CCD_PAIRS] = work_for(counts.fast != 0u ? counts.pairs : 0u, parameters);
    return counts;
}

// The dispatch of one pair type, whose pairs are [first, last).
LAW Counts with_kinds(Counts counts, uint pair_type, uint first, uint last, Parameters parameters) {
    counts.pair_type_first[pair_type] = first;
    counts.pair_type_first[pair_type + 1u] = last;
    counts.arguments[WORK_PAIR_TYPE + pair_type] = work_for(last - first, parameters);
    return counts;
}

// Whether the pairs with points, of which continuous collision may drop some, are more than there is room for.
LAW bool lacks_room(Counts counts, Parameters parameters) {
    return counts.contacts > parameters.contact_capacity;
}
// The dispatches that follow from the number of contacts.
LAW Counts with_contacts(Counts counts, uint total, Parameters parameters) {
    if (lacks_room(counts, parameters)) {
        counts.overflow = counts.overflow | OVERFLOW_CONTACTS;
        counts.required_contacts = counts.contacts;
        counts.pairs = 0u;
        counts.arguments[WORK_PAIRS] = work_for(0u, parameters);
        counts.arguments[WORK_CCD_PAIRS] = work_for(0u, parameters);
    }
    counts.contacts = counts.overflow == 0u ? total : 0u;
    counts.arguments[WORK_CONTACTS] = work_for(counts.contacts, parameters);
    return counts;
}

// No work, at the start of a step and after an overflow. Scans still write their total.
LAW uvec4 empty_work(uint row, Parameters parameters) {
    return row == WORK_PAIR_TYPE_SCAN_BLOCKS || row == WORK_PAIR_SCAN_BLOCKS ? scan_work_for(0u, parameters)
                                                                             : work_for(0u, parameters);
}
LAW Counts emptied(Counts counts, Parameters parameters) {
    counts.pairs = 0u;
    counts.contacts = 0u;
    counts.levels = 0u;
    counts.levels_stirring = 0u;
    counts.large_stirring = parameters.removed;
    counts.sleepers = 0u;
    counts.solver_contacts = 0u;
    counts.pairs_coarse = 0u;
    counts.fast = 0u;
    counts.broken = 0u;
    for (uint k = 0u; k < PAIR_TYPES + 1u; ++k) counts.pair_type_first[k] = 0u;
    for (uint k = 0u; k < WORKS; ++k) counts.arguments[k] = empty_work(k, parameters);
    return counts;
}

// Whether any body may move in this step: if not, no body wakes and no contact is solved.
LAW bool any_stirs(Counts counts) {
    return counts.levels_stirring != 0u || counts.large_stirring != 0u;
}

LAWS_END

#endif
