// The equations of blocks of joints in lanes: entries, elimination, substitution. For compute/cpu/simd/simd_blocks.cpp.
//
// What is an unknown in some lanes only has in the others an entry of 1 on the diagonal and else zeros, which change nothing.
#pragma once

#include "compute/cpu/simd/block_lanes.h"

LAWS_BEGIN

namespace {

// The entries of row n of `later` and column k of a joint.
SCREE_INLINE Float entry_of(const Row& later, int n, RowResponse to, int k, int32_t ends) {
    const bool both_linear = n < 3 && k < 3;
    const JointRow& row = later.row;
    if (both_linear) {
        to.axis = 0u;
        return row_entry(row.direction, row.angular_a, row.angular_b, 0u, to, ends);
    }
    to.axis = 3u;
    return row_entry(row.direction, row.angular_a, row.angular_b, 3u, to, ends);
}
SCREE_INLINE RowResponse response_of(const Row& row, const Mass& a, const Mass& b) {
    RowResponse to;
    to.direction = row.row.direction;
    to.turn_a = row.turn_a;
    to.turn_b = row.turn_b;
    to.inverse_mass_a = a.inverse_mass;
    to.inverse_mass_b = b.inverse_mass;
    to.split_a = a.split;
    to.split_b = b.split;
    return to;
}

SCREE_INLINE void fill_own(const JointInLanes& joint, Tile& own, const Mass& a, const Mass& b, int32_t ends) {
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.unknown, k)) continue;
        const Row& column = joint.rows[k];
        const RowResponse to = response_of(column, a, b);
        const Float diagonal = softened(entry_of(column, k, to, k, ends), column.compliance);
        own.of[7 * k] = choose(column.unknown, diagonal, 1.0f);
        for (int n = k + 1; n < 6; ++n)
            if (has(joint.unknown, n))
                own.of[6 * n + k] = only(column.unknown && joint.rows[n].unknown, entry_of(joint.rows[n], n, to, k, ends));
    }
}
SCREE_INLINE void fill_link(const JointInLanes& joint, const JointInLanes& later, Tile& tile, const Mass& a, const Mass& b,
                            int32_t ends) {
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.unknown, k)) continue;
        const Row& column = joint.rows[k];
        const RowResponse to = response_of(column, a, b);
        for (int n = 0; n < 6; ++n)
            if (has(later.unknown, n))
                tile.of[6 * n + k] = only(column.unknown && later.rows[n].unknown, entry_of(later.rows[n], n, to, k, ends));
    }
}

// Eliminates the unknowns of a joint from its own later equations.
SCREE_INLINE void factor(JointInLanes& joint, Tile& own) {
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.unknown, k)) continue;
        Row& pivot = joint.rows[k];
        pivot.inverse_pivot = reciprocal(own.of[7 * k]);
        for (int n = k + 1; n < 6; ++n) {
            if (!has(joint.unknown, n)) continue;
            const Float multiplier = multiplier_of(own.of[6 * n + k], pivot.inverse_pivot);
            joint.rows[n].solution = less_multiple(joint.rows[n].solution, multiplier, pivot.solution);
            for (int c = k + 1; c <= n; ++c)
                if (has(joint.unknown, c)) own.of[6 * n + c] = less_multiple(own.of[6 * n + c], multiplier, own.of[6 * c + k]);
        }
    }
}
// From the equations of a later joint that are coupled with them.
SCREE_INLINE void factor_link(const JointInLanes& joint, const Tile& own, JointInLanes& later, Tile& tile) {
    for (int n = 0; n < 6; ++n) {
        if (!has(later.unknown, n)) continue;
        Float solution = later.rows[n].solution;
        Float* const row = tile.of + 6 * n;
        for (int k = 0; k < 6; ++k) {
            if (!has(joint.unknown, k)) continue;
            const Float multiplier = multiplier_of(row[k], joint.rows[k].inverse_pivot);
            solution = less_multiple(solution, multiplier, joint.rows[k].solution);
            for (int c = k + 1; c < 6; ++c)
                if (has(joint.unknown, c)) row[c] = less_multiple(row[c], multiplier, own.of[6 * c + k]);
        }
        later.rows[n].solution = solution;
    }
}
// From the entries between two later joints, `row` of the later and `column` of the earlier; of one joint: `triangle`.
SCREE_INLINE void lessen(Tile& target, const JointInLanes& joint, const Tile& row, const JointInLanes& later, const Tile& column,
                         const JointInLanes& middle, bool triangle) {
    for (int n = 0; n < 6; ++n) {
        if (!has(later.unknown, n)) continue;
        Float multipliers[6];
        for (int k = 0; k < 6; ++k)
            if (has(joint.unknown, k)) multipliers[k] = multiplier_of(row.of[6 * n + k], joint.rows[k].inverse_pivot);
        for (int c = 0; c < (triangle ? n + 1 : 6); ++c) {
            if (!has(middle.unknown, c)) continue;
            Float entry = target.of[6 * n + c];
            for (int k = 0; k < 6; ++k)
                if (has(joint.unknown, k)) entry = less_multiple(entry, multipliers[k], column.of[6 * c + k]);
            target.of[6 * n + c] = entry;
        }
    }
}

SCREE_INLINE Tile& tile_with(const Pass& pass, uint32_t j, uint32_t later) {
    const JointShape& shape = pass.shape(j);
    uint32_t l = 0;
    while (l + 1 < shape.links && shape.link[l] != later) ++l;  // ends also for forged tables
    return pass.tiles[shape.first_tile + 1 + l];
}

void eliminate(Pass& pass, uint32_t j) {
    const JointShape& shape = pass.shape(j);
    JointInLanes& joint = pass.joints[j];
    if (joint.unknown == 0) return;
    Tile* const own = pass.tiles + shape.first_tile;
    factor(joint, *own);
    for (uint32_t l = 0; l < shape.links; ++l) factor_link(joint, *own, pass.joints[shape.link[l]], own[1 + l]);
    for (uint32_t l = 0; l < shape.links; ++l) {
        const JointInLanes& later = pass.joints[shape.link[l]];
        if (later.unknown == 0) continue;
        for (uint32_t e = 0; e < l; ++e)
            lessen(tile_with(pass, shape.link[e], shape.link[l]), joint, own[1 + l], later, own[1 + e],
                   pass.joints[shape.link[e]], false);
        lessen(pass.tiles[pass.shape(shape.link[l]).first_tile], joint, own[1 + l], later, own[1 + l], later, true);
    }
}

void substitute(Pass& pass, uint32_t j) {
    const JointShape& shape = pass.shape(j);
    JointInLanes& joint = pass.joints[j];
    const Tile* const own = pass.tiles + shape.first_tile;
    for (int k = 5; k >= 0; --k) {
        if (!has(joint.unknown, k)) continue;
        Float sum = joint.rows[k].solution;
        for (int n = k + 1; n < 6; ++n)
            if (has(joint.unknown, n)) sum = less_multiple(sum, own->of[6 * n + k], joint.rows[n].solution);
        for (uint32_t l = 0; l < shape.links; ++l) {
            const JointInLanes& later = pass.joints[shape.link[l]];
            for (int n = 0; n < 6; ++n)
                if (has(later.unknown, n)) sum = less_multiple(sum, own[1 + l].of[6 * n + k], later.rows[n].solution);
        }
        joint.rows[k].solution = only(joint.rows[k].unknown, substituted(sum, joint.rows[k].inverse_pivot));
    }
}

// Solves the equations; false if a solution is not finite.
SCREE_INLINE bool solve_equations(Pass& pass) {
    const uint32_t joints = pass.group.shape.joints;
    for (uint32_t j = 0; j < joints; ++j) {
        const JointShape& shape = pass.shape(j);
        const Mass a = mass_of(pass, shape.a), b = mass_of(pass, shape.b);
        Tile* const own = pass.tiles + shape.first_tile;
        fill_own(pass.joints[j], *own, a, b, shape.own_ends);
        for (uint32_t l = 0; l < shape.links; ++l)
            fill_link(pass.joints[j], pass.joints[shape.link[l]], own[1 + l], a, b, shape.ends[l]);
    }
    for (uint32_t j = 0; j < joints; ++j) eliminate(pass, j);
    for (uint32_t j = joints; j-- > 0;) substitute(pass, j);
    Bool finite = true;
    for (uint32_t j = 0; j < joints; ++j)
        for (int k = 0; k < 6; ++k)
            if (has(pass.joints[j].unknown, k)) finite = finite && is_finite(pass.joints[j].rows[k].solution);
    return none(!finite);
}

}  // namespace

LAWS_END
