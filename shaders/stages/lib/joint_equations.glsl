// The equations of a pass over a block of joints: their entries, elimination and substitution.
#ifndef SCREE_STAGES_JOINT_EQUATIONS_GLSL
#define SCREE_STAGES_JOINT_EQUATIONS_GLSL

// As row_response() in joint_block.h, of vectors in memory.
RowResponse response_of_row(uint j, uint k) {
    Mass mass_a = mass_of_side(side_a(j)), mass_b = mass_of_side(side_b(j));
    RowResponse to;
    to.direction = row_vector(j, k, DIRECTION);
    to.axis = k;
    to.turn_a = row_vector(j, k, TURN_A);
    to.inverse_mass_a = mass_a.inverse_mass;
    to.turn_b = row_vector(j, k, TURN_B);
    to.inverse_mass_b = mass_b.inverse_mass;
    to.split_a = mass_a.split;
    to.split_b = mass_b.split;
    return to;
}

// The entries of unknown k of joint j: those of its own and those of the joints linked with it.
void set_up_column(uint j, uint k) {
    uint a = side_a(j), b = side_b(j);
    RowResponse to = response_of_row(j, k);
    float compliance = given_impulses[6u * j + k];
    uint slots_end = links_of(j) + 1u;
    for (uint slot = 0u; slot < slots_end; ++slot) {
        uint i = slot == 0u ? j : link_of(j, slot - 1u), at = tile_at(j, slot);
        int ends = shared_ends(side_a(i), side_b(i), a, b);
        FOR_AXES (n, slot == 0u ? unknowns[i] & (63u << k) : unknowns[i]) {
            vec3 direction = vec3(0.0f), angular_a = vec3(0.0f), angular_b = vec3(0.0f);
            if (is_linear(k) && is_linear(n)) direction = row_vector(i, n, DIRECTION);
            if ((ends & (ENDS_A_A | ENDS_A_B)) != 0) angular_a = row_vector(i, n, ANGULAR_A);
            if ((ends & (ENDS_B_A | ENDS_B_B)) != 0) angular_b = row_vector(i, n, ANGULAR_B);
            float entry = row_entry(direction, angular_a, angular_b, n, to, ends);
            if (slot == 0u && n == k) entry = softened(entry, compliance);
            TILE(j, at + 6u * n + k) = entry;
        }
    }
}

// Eliminates the unknowns of joint j from all later equations. Each thread factors the joint's own rows. Loops over six
// have fixed ends, so that drivers can keep the six in registers.
void eliminate(uint j) {
    uint own_axes = unknowns[j], count = links_of(j), own_at = tile_at(j, 0u);
    float own[36], known[6], inverse[6];
    for (uint n = 0u; n < 6u; ++n) {
        known[n] = solutions[6u * j + n];
        for (uint c = 0u; c < 6u; ++c) own[6u * n + c] = TILE(j, own_at + 6u * n + c);
    }
    end_part();
#define FACTOR_FROM(k)                                                                                              \
    if (has(own_axes, k)) {                                                                                         \
        inverse[k] = reciprocal(own[7u * k]);                                                                       \
        for (uint n = 0u; n < 6u; ++n) {                                                                            \
            if (n <= k) continue;                                                                                   \
            float multiplier = multiplier_of(own[6u * n + k], inverse[k]);                                          \
            known[n] = less_multiple(known[n], multiplier, known[k]);                                               \
            for (uint c = 0u; c < 6u; ++c)                                                                          \
                if (c > k && c <= n) own[6u * n + c] = less_multiple(own[6u * n + c], multiplier, own[6u * c + k]); \
        }                                                                                                           \
    }
    FACTOR_FROM(0u);
    FACTOR_FROM(1u);
    FACTOR_FROM(2u);
    FACTOR_FROM(3u);
    FACTOR_FROM(4u);
    FACTOR_FROM(5u);
    if (leads()) {
        for (uint n = 0u; n < 6u; ++n) {
            solutions[6u * j + n] = known[n];
            pivots[6u * j + n] = inverse[n];
            for (uint c = 0u; c < 6u; ++c)
                if (c < n) TILE(j, own_at + 6u * n + c) = own[6u * n + c];
        }
    }
    FOR_LANES(t, 6u * count) {
        uint l = sixth_of(t), n = t - 6u * l, i = link_of(j, l), at = tile_at(j, 1u + l) + 6u * n;
        if (!has(unknowns[i], n)) continue;
        float row[6], sum = solutions[6u * i + n];
        for (uint k = 0u; k < 6u; ++k) row[k] = TILE(j, at + k);
        for (uint k = 0u; k < 6u; ++k) {
            if (!has(own_axes, k)) continue;
            float multiplier = multiplier_of(row[k], inverse[k]);
            sum = less_multiple(sum, multiplier, known[k]);
            for (uint c = 0u; c < 6u; ++c)
                if (c > k) row[c] = less_multiple(row[c], multiplier, own[6u * c + k]);
        }
        solutions[6u * i + n] = sum;
        for (uint k = 0u; k < 6u; ++k) TILE(j, at + k) = row[k];
    }
    end_part();
    // The equations of the joints linked with it, and those between two of them: entries [n][c] of a tile.
    float column[36];
    FOR_LANES(t, 3u * count * (count + 1u)) {
        uint pair = sixth_of(t), n = t - 6u * pair;
        uint l = (pair >= 1u ? 1u : 0u) + (pair >= 3u ? 1u : 0u) + (pair >= 6u ? 1u : 0u) + (pair >= 10u ? 1u : 0u) +
                 (pair >= 15u ? 1u : 0u) + (pair >= 21u ? 1u : 0u) + (pair >= 28u ? 1u : 0u);
        uint e = pair - (l * (l + 1u) >> 1), later = link_of(j, l), middle = link_of(j, e), slot = 0u;
#ifdef SCREE_SINGLY
        if (n == 0u)
#endif
            for (uint c = 0u; c < 6u; ++c)
                for (uint k = 0u; k < 6u; ++k) column[6u * c + k] = TILE(j, tile_at(j, 1u + e) + 6u * c + k);
        if (!has(unknowns[later], n)) continue;
        if (e != l) {
            uint all = links_of(middle);
            slot = 1u;
            for (uint s = 0u; s < all; ++s)
                if (link_of(middle, s) < later) ++slot;
        }
        uint at = tile_at(middle, slot) + 6u * n, row_at = tile_at(j, 1u + l) + 6u * n;
        float target[6];
        for (uint c = 0u; c < 6u; ++c) target[c] = TILE(middle, at + c);
        for (uint k = 0u; k < 6u; ++k) {
            if (!has(own_axes, k)) continue;
            float multiplier = multiplier_of(TILE(j, row_at + k), inverse[k]);
            for (uint c = 0u; c < 6u; ++c) target[c] = less_multiple(target[c], multiplier, column[6u * c + k]);
        }
        for (uint c = 0u; c < 6u; ++c) TILE(middle, at + c) = target[c];
    }
    end_part();
}

void substitute(uint j) {
    uint own_axes = unknowns[j], count = links_of(j), own_at = tile_at(j, 0u);
    for (uint k = 6u; k-- > 0u;) {
        if (!has(own_axes, k)) continue;
        float sum = solutions[6u * j + k];
        for (uint n = k + 1u; n < 6u; ++n)
            if (has(own_axes, n)) sum = less_multiple(sum, TILE(j, own_at + 6u * n + k), solutions[6u * j + n]);
        for (uint l = 0u; l < count; ++l) {
            uint i = link_of(j, l), at = tile_at(j, 1u + l), theirs = unknowns[i];
            for (uint n = 0u; n < 6u; ++n)
                if (has(theirs, n)) sum = less_multiple(sum, TILE(j, at + 6u * n + k), solutions[6u * i + n]);
        }
        sum = substituted(sum, pivots[6u * j + k]);
        solutions[6u * j + k] = sum;
        given_impulses[6u * j + k] = sum;
    }
    pushing[j] = own_axes;
}

#ifdef SCREE_COUPLED
#include "shaders/stages/lib/pass_couplings.glsl"
#endif

void solve_equations() {
    FOR_LANES(j, block_joints) set_up_sides(j);
    end_part();
    FOR_LANES(t, 6u * block_joints) {
        uint j = sixth_of(t), k = t - 6u * j;
        if (has(unknowns[j], k)) set_up_column(j, k);
    }
    end_part();
    for (uint j = 0u; j < block_joints; ++j) eliminate(j);
#ifdef SCREE_COUPLED
    solve_border();
#endif
    if (leads()) {
        for (uint j = block_joints; j-- > 0u;) substitute(j);
#ifdef SCREE_COUPLED
        add_coupled_solutions();
#endif
    }
}

#endif
