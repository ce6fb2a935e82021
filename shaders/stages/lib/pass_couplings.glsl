// The couplings in a pass over a block of joints: the border of its equations. One thread does what depends on the order of the
// couplings.
#ifndef SCREE_STAGES_PASS_COUPLINGS_GLSL
#define SCREE_STAGES_PASS_COUPLINGS_GLSL

BLOCK_SHARED uint touched[2u * MAX_COUPLED_BLOCK];  // of each coupling: the joints in whose rows its column is not 0, a bit each

uint joint_in_block(uint term) {
    return joint_of_term(term) - block_first_joint;
}

// The entry of its equation with row `at` of the block, 6 joint + axis, is where a joint has its tiles.
#define COLUMN(g, row) joint_equations.at[block_first_joint + (g)].tiles[row]

float speed_of_row(uint joint, uint k) {
    uint j = joint - block_first_joint;
    return speed_of(j, k, couple_of(j));
}

// ---- impulses
// Adds a coupling's impulse, times its factors, to the impulses that its joints' rows will apply.
void add_to_terms(uint g, float impulse) {
    if (impulse == 0.0f) return;
    uint coupling = block_first_joint + g, count = terms_of(coupling);
    FOR_TERMS (t, count) {
        uint j = joint_in_block(term_of(coupling, t)), k = axis_of_term(term_of(coupling, t));
        float before = 0.0f;
        if (has(pushing[j], k)) before = given_impulses[6u * j + k];
        given_impulses[6u * j + k] = with_part(before, factor_of(coupling, t), impulse);
        pushing[j] |= 1u << k;
    }
}

// ---- a round
float speed_of_coupling(uint g, bool before) {
    uint coupling = block_first_joint + g, count = terms_of(coupling);
    float sum = 0.0f;
    FOR_TERMS (t, count) {
        uint j = joint_in_block(term_of(coupling, t)), k = axis_of_term(term_of(coupling, t));
        VelocityPair v;
        if (before) {
            v.a = velocity_at_first(JOINT(j).a);
            v.b = velocity_at_first(JOINT(j).b);
        } else {
            v = couple_of(j);
        }
        sum = with_part(sum, factor_of(coupling, t), speed_of(j, k, v));
    }
    return sum;
}

// Adds the given impulses of the couplings to their joints' rows. One thread does it.
void pass_on_impulses() {
    for (uint g = first_coupling(); g < block_joints; ++g) {
        if (pushing[g] == 0u) continue;
        pushing[g] = 0u;
        add_to_terms(g, given_impulses[6u * g]);
    }
}

// ---- equations
// The entry of row k of a joint with a coupling's row.
float coupled_entry(uint j, uint k, uint g) {
    uint coupling = block_first_joint + g, count = terms_of(coupling);
    float sum = 0.0f;
    FOR_TERMS (t, count) {
        uint i = joint_in_block(term_of(coupling, t)), axis = axis_of_term(term_of(coupling, t));
        int ends = shared_ends(side_a(j), side_b(j), side_a(i), side_b(i));
        if (ends == 0) continue;
        RowResponse to = response_of_row(i, axis);
        float entry =
            row_entry(row_vector(j, k, DIRECTION), row_vector(j, k, ANGULAR_A), row_vector(j, k, ANGULAR_B), k, to, ends);
        sum = with_entry(sum, factor_of(coupling, t), entry);
    }
    return sum;
}
float entry_between(uint g, uint other) {
    uint coupling = block_first_joint + g, count = terms_of(coupling);
    float sum = 0.0f;
    FOR_TERMS (t, count)
        sum = with_entry(sum, factor_of(coupling, t),
                         coupled_entry(joint_in_block(term_of(coupling, t)), axis_of_term(term_of(coupling, t)), other));
    return sum;
}

// Forward elimination of a coupling's column by the joints' factors.
void eliminate_column(uint g) {
    uint inner = first_coupling();
    touched[2u * g] = touched[2u * g + 1u] = 0u;
    for (uint j = 0u; j < inner; ++j) {
        uint own_axes = unknowns[j], count = links_of(j), own_at = tile_at(j, 0u);
        bool touches = false;
        FOR_AXES (k, own_axes) touches = touches || COLUMN(g, 6u * j + k) != 0.0f;
        if (!touches) continue;
        touched[2u * g + (j >> 5)] |= 1u << (j & 31u);
        FOR_AXES (k, own_axes) {
            float entry = COLUMN(g, 6u * j + k), inverse = pivots[6u * j + k];
            if (entry == 0.0f) continue;
            // of its own later rows, then of the joints linked with it
            for (uint slot = 0u; slot <= count; ++slot) {
                uint i = slot == 0u ? j : link_of(j, slot - 1u), at = tile_at(j, slot) + k;
                uint rows = slot == 0u ? own_axes & (0xFFFFFFFEu << k) : unknowns[i];
                FOR_AXES (n, rows)
                    COLUMN(g, 6u * i + n) =
                        less_multiple(COLUMN(g, 6u * i + n), multiplier_of(TILE(j, at + 6u * n), inverse), entry);
            }
        }
    }
}
// Calls for the rows of joints in which the columns of both couplings may not be 0.
#define FOR_TOUCHED(j, k, g, with)                                               \
    for (uint w = 0u; w < 2u; ++w)                                               \
        FOR_AXES (bit, touched[2u * (g) + w] & touched[2u * (with) + w])         \
            for (uint j = 32u * w + bit, axes_left = unknowns[32u * w + bit], k; \
                 axes_left != 0u && (k = uint(findLSB(axes_left))) < 32u; axes_left &= axes_left - 1u)
// Eliminates the joints' rows from the entry with an earlier coupling, or from the diagonal entry.
float eliminated_by_joints(uint g, float entry, uint with) {
    FOR_TOUCHED(j, k, g, with) {
        float own = COLUMN(g, 6u * j + k), other = COLUMN(with, 6u * j + k);
        if (own != 0.0f && other != 0.0f) entry = less_multiple(entry, multiplier_of(other, pivots[6u * j + k]), own);
    }
    return entry;
}
// Eliminates the couplings before that one from the entry.
float eliminated_by_couplings(uint g, uint with) {
    float entry = COLUMN(g, 6u * with);
    for (uint e = first_coupling(); e < with; ++e)
        if (is_unknown[e] != 0u)
            entry = less_multiple(entry, multiplier_of(COLUMN(with, 6u * e), pivots[6u * e]), COLUMN(g, 6u * e));
    return entry;
}
void eliminate_coupling(uint g) {
    uint inner = first_coupling();
    for (uint e = inner; e <= g; ++e) {
        if (is_unknown[e] == 0u) continue;
        float entry = eliminated_by_couplings(g, e);
        if (e == g)
            pivots[6u * g] = reciprocal(entry);
        else
            COLUMN(g, 6u * e) = entry;
    }
    float sum = solutions[6u * g];
    FOR_TOUCHED(j, k, g, g) {
        float own = COLUMN(g, 6u * j + k);
        if (own != 0.0f) sum = less_multiple(sum, multiplier_of(own, pivots[6u * j + k]), solutions[6u * j + k]);
    }
    for (uint e = inner; e < g; ++e)
        if (is_unknown[e] != 0u) sum = less_multiple(sum, multiplier_of(COLUMN(g, 6u * e), pivots[6u * e]), solutions[6u * e]);
    solutions[6u * g] = sum;
}
// Back substitution; lessen_row() then takes the couplings' impulses to a joint's right-hand side.
void substitute_couplings() {
    for (uint g = block_joints; g-- > first_coupling();) {
        if (is_unknown[g] == 0u) continue;
        float sum = solutions[6u * g];
        for (uint later = g + 1u; later < block_joints; ++later)
            if (is_unknown[later] != 0u) sum = less_multiple(sum, COLUMN(later, 6u * g), solutions[6u * later]);
        solutions[6u * g] = substituted(sum, pivots[6u * g]);
    }
}
void lessen_row(uint j, uint at) {
    for (uint g = first_coupling(); g < block_joints; ++g) {
        if (is_unknown[g] == 0u || !has(touched[2u * g + (j >> 5)], j & 31u)) continue;
        float entry = COLUMN(g, at);
        if (entry != 0.0f) solutions[at] = less_multiple(solutions[at], entry, solutions[6u * g]);
    }
}

// Between elimination and substitution of the joints.
void solve_border() {
    uint inner = first_coupling(), rows = 6u * inner, all = block_joints - inner;
    for (uint g = inner; g < block_joints; ++g) FOR_LANES(at, rows) {
            uint j = sixth_of(at), k = at - 6u * j;
            if (is_unknown[g] != 0u && has(unknowns[j], k)) COLUMN(g, at) = coupled_entry(j, k, g);
        }
    end_part();
    FOR_LANES(i, all) if (is_unknown[inner + i] != 0u) eliminate_column(inner + i);
    end_part();
    for (uint g = inner; g < block_joints; ++g) FOR_LANES(i, g + 1u - inner) {
            uint e = inner + i;
            if (is_unknown[g] == 0u || is_unknown[e] == 0u) continue;
            float entry = entry_between(e, g);
            if (e == g) entry = softened(entry, given_impulses[6u * g]);
            COLUMN(g, 6u * e) = eliminated_by_joints(g, entry, e);
        }
    end_part();
    if (leads()) {
        for (uint g = inner; g < block_joints; ++g)
            if (is_unknown[g] != 0u) eliminate_coupling(g);
        substitute_couplings();
    }
    end_part();
    FOR_LANES(at, rows) {
        uint j = sixth_of(at);
        if (has(unknowns[j], at - 6u * j)) lessen_row(j, at);
    }
    end_part();
}
// After the substitution of the joints, by the same thread.
void add_coupled_solutions() {
    for (uint g = first_coupling(); g < block_joints; ++g)
        if (is_unknown[g] != 0u) add_to_terms(g, solutions[6u * g]);
}

#endif
