// A pass over one block of joints by one thread: equations, elimination, back substitution, active set.
//
// lavapipe silently ends a shader's loops after 65,535 rounds in all, which the elimination of nine joints in a ring
// exceeded as nested loops. So loops over six rows are unrolled (EACH_OF_SIX), and rounds of a block that would still
// exceed it go to further dispatches (compute/step/stage_fusion.h, which knows how many rounds each loop here takes).
#ifndef SCREE_STAGES_JOINTS_GLSL
#define SCREE_STAGES_JOINTS_GLSL

#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/joint_block.h"

#define EACH_OF_SIX(DO) DO(0u) DO(1u) DO(2u) DO(3u) DO(4u) DO(5u)

uint block, block_first_joint, block_joints_end, block_first_body, block_bodies_end;

// False if there is no such block, or no body of it can move.
bool enter_block(uint index) {
    if (index >= PARAMETERS.joint_blocks || COUNTS.overflow != 0u) return false;
    block = index;
    block_first_joint = joint_blocks.at[block].first_joint;
    block_joints_end = block_first_joint + joint_blocks.at[block].joints;
    block_first_body = joint_blocks.at[block].first_body;
    block_bodies_end = block_first_body + joint_blocks.at[block].bodies;
    bool moves = false;
    for (uint m = block_first_body; m < block_bodies_end && !moves; ++m) moves = block_bodies.at[m].slot != NONE;
    return moves;
}

bool holds(uint j) {
    return joints.at[j].broken == 0u;
}

Pose pose_of(uint body) {
    if (body != NONE) return poses.at[body];
    return Pose(vec3(0.0f), 0.0f, vec4(0.0f, 0.0f, 0.0f, 1.0f));
}
Velocity velocity_of(uint body, uint block_body) {
    if (block_body != NONE) return block_bodies.at[block_body].velocity;
    if (body != NONE) return velocities.at[body];
    return Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
}
VelocityPair couple_of(uint j) {
    VelocityPair v;
    v.a = velocity_of(joints.at[j].a, joints.at[j].block_body_a);
    v.b = velocity_of(joints.at[j].b, joints.at[j].block_body_b);
    return v;
}

Mass mass_of(uint block_body) {
    if (block_body != NONE) return block_bodies.at[block_body].mass;
    return Mass(0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
}

// Split masses of the block's bodies.
void lend(bool after_contacts) {
    for (uint m = block_first_body; m < block_bodies_end; ++m)
        block_bodies.at[m].mass =
            mass_of_member(masses.at[block_bodies.at[m].body], block_bodies.at[m].slot != NONE, block_bodies.at[m].blocks,
                           block_bodies.at[m].normal_sum, after_contacts, PARAMETERS);
}
// Whether a body of the block has an impact in this substep: then joints are relaxed after the contacts as well.
bool is_struck() {
    bool struck = false;
    for (uint m = block_first_body; m < block_bodies_end; ++m)
        if (forces.at[block_bodies.at[m].body].impacts != 0.0f) struck = true;
    return struck;
}

// Velocities of the block's bodies; after the contacts with this pass's changes by them, in the slots before those of
// joints.
void take_velocities(bool after_contacts) {
    for (uint m = block_first_body; m < block_bodies_end; ++m) {
        uint body = block_bodies.at[m].body;
        Velocity velocity = velocities.at[body];
        if (after_contacts && block_bodies.at[m].slot != NONE) {
            uint last = WORD(slot_ends, body) - block_bodies.at[m].blocks;
            for (uint k = body == 0u ? 0u : WORD(slot_ends, body - 1u); k < last; ++k)
                velocity = changed_by(velocity, slots.at[k]);
        }
        block_bodies.at[m].velocity_before = velocity;
        block_bodies.at[m].velocity = velocity;
    }
}
void restore_velocities() {
    for (uint m = block_first_body; m < block_bodies_end; ++m) block_bodies.at[m].velocity = block_bodies.at[m].velocity_before;
}

// Jacobian rows of a joint at the present poses.
void place_rows(uint j) {
    uint a = joints.at[j].a, b = joints.at[j].b;
    JointConfiguration at = joint_configuration(joints.at[j].anchor_a, joints.at[j].frame_a, pose_of(a), joints.at[j].anchor_b,
                                                joints.at[j].frame_b, pose_of(b));
    VelocityPair v = couple_of(j);
    uint flags = joints.at[j].flags;
    uint side_a = joints.at[j].block_body_a, side_b = joints.at[j].block_body_b;
    Mass mass_a = mass_of(side_a), mass_b = mass_of(side_b);
    for (uint k = 0u; k < 6u; ++k) {
        if (joints.at[j].axes[k].mode == 0u) continue;
        joints.at[j].rows[k] = placed_row(joints.at[j].rows[k], at, int(k), flags, v, mass_a, mass_b, side_a != NONE,
                                          side_b != NONE, joints.at[j].rotors[k].inertia, PARAMETERS.h);
    }
}

// As a step begins, those of their axes for rotors that follow them.
void take_rotor_speeds(uint j, bool restart) {
    VelocityPair v = couple_of(j);
    for (uint k = 0u; k < 6u; ++k)
        if (has_rotor(joints.at[j].axes[k]) && rotor_follows(joints.at[j].rotors[k], restart))
            joints.at[j].rotors[k].speed = row_speed(joints.at[j].rows[k], is_linear(k), v);
}

void push_row(uint j, uint k, float impulse) {
    JointRow row = joints.at[j].rows[k];
    uint side_a = joints.at[j].block_body_a, side_b = joints.at[j].block_body_b;
    bool linear = is_linear(k);
    if (side_a != NONE)
        block_bodies.at[side_a].velocity = row_pushed(block_bodies.at[side_a].velocity, row.direction, row.angular_a, -impulse,
                                                      linear, block_bodies.at[side_a].mass);
    if (side_b != NONE)
        block_bodies.at[side_b].velocity = row_pushed(block_bodies.at[side_b].velocity, row.direction, row.angular_b, impulse,
                                                      linear, block_bodies.at[side_b].mass);
}

// Chooses the axes that are unknowns; the impulses of the others are given and applied at once.
void choose_unknowns(uint j, bool biased) {
    uint unknowns = 0u;
    uint active_set = joints.at[j].active_set;
    VelocityPair v;
    v.a = velocity_of(NONE, NONE);
    v.b = v.a;
    if (joints.at[j].a != NONE) v.a = velocities.at[joints.at[j].a];
    if (joints.at[j].b != NONE) v.b = velocities.at[joints.at[j].b];
    for (uint k = 0u; k < 6u; ++k) {
        JointAxis axis = joints.at[j].axes[k];
        JointRow row = joints.at[j].rows[k];
        if (!row_acts(axis, row)) continue;
        uint active_flags = active_set_of(active_set, k);
        if (row_is_unknown(axis, row, active_flags, biased, PARAMETERS)) unknowns |= 1u << k;
        row = row_given(axis, row, active_flags, row_speed(row, is_linear(k), v), biased, PARAMETERS);
        joints.at[j].rows[k] = row;
        float given = given_change(row);
        if (given != 0.0f) push_row(j, k, given);
    }
    joints.at[j].solved_axes = unknowns;
}

#define UP_TO(n) ((2u << n) - 1u)  // bits 0 to n of a set of axes

bool has(uint axes, uint k) {
    return (axes >> k & 1u) != 0u;
}
bool unknown(uint j, uint k) {
    return has(joints.at[j].solved_axes, k);
}

// The matrix entry of row n of joint i and the row of a response, whose joint connects these bodies of the block.
float entry_of(uint i, uint n, RowResponse to, uint block_body_a, uint block_body_b) {
    return row_entry(joints.at[i].rows[n].direction, joints.at[i].rows[n].angular_a, joints.at[i].rows[n].angular_b, n, to,
                     shared_ends(joints.at[i].block_body_a, joints.at[i].block_body_b, block_body_a, block_body_b));
}

void set_up_equation(uint j, uint k, VelocityPair v, bool biased) {
    JointRow row = joints.at[j].rows[k];
    RowTarget demand = row_demand(joints.at[j].axes[k], row, joints.at[j].rotors[k], k, active_set_of(joints.at[j].active_set, k),
                                  biased, PARAMETERS);
    joint_equations.at[j].solution[k] = right_hand_side(row_speed(row, is_linear(k), v), demand.bias);
    uint block_body_a = joints.at[j].block_body_a, block_body_b = joints.at[j].block_body_b;
    RowResponse response = row_response(row, k, mass_of(block_body_a), mass_of(block_body_b));
    uint own = joints.at[j].solved_axes;
#define SET_UP_OWN(n) \
    if (n >= k && has(own, n)) joint_equations.at[j].diagonal[6u * n + k] = entry_of(j, n, response, block_body_a, block_body_b);
    EACH_OF_SIX(SET_UP_OWN)
    joint_equations.at[j].diagonal[7u * k] = softened(joint_equations.at[j].diagonal[7u * k], demand.compliance);
    uint fill_in = joints.at[j].fill_in;
    for (uint l = 0u; l < fill_in; ++l) {
        uint i = joints.at[j].fill_in_of[l], theirs = joints.at[i].solved_axes;
#define SET_UP_LINK(n)  \
    if (has(theirs, n)) \
        joint_equations.at[j].coupling[36u * l + 6u * n + k] = entry_of(i, n, response, block_body_a, block_body_b);
        EACH_OF_SIX(SET_UP_LINK)
    }
}
void set_up_equations(uint j, bool biased) {
    VelocityPair v = couple_of(j);
    for (uint k = 0u; k < 6u; ++k)
        if (unknown(j, k)) set_up_equation(j, k, v, biased);
}

// Where joint j stores its coupling with joint i; fill_in_of is ascending.
uint coupling_with(uint i, uint j) {
    uint fill_in = joints.at[j].fill_in, before = 0u;
#define COUNT_BEFORE(l) \
    if (l < fill_in && joints.at[j].fill_in_of[l] < i) ++before;
    EACH_OF_SIX(COUNT_BEFORE)
    COUNT_BEFORE(6u)
    COUNT_BEFORE(7u)
    return 36u * before;
}

// Column k of joint j in its own six rows, or in those of its fill-in l.
struct Column {
    float at[6];
};
Column own_column(uint j, uint k) {
    Column column;
#define TAKE_OWN(n) column.at[n] = joint_equations.at[j].diagonal[6u * n + k];
    EACH_OF_SIX(TAKE_OWN)
    return column;
}
Column column_of_link(uint j, uint l, uint k) {
    Column column;
#define TAKE_LINK(n) column.at[n] = joint_equations.at[j].coupling[36u * l + 6u * n + k];
    EACH_OF_SIX(TAKE_LINK)
    return column;
}

// Subtracts a multiple of a column from a row, in the unknowns `of`.
void lessen_diagonal(uint j, uint row, uint of, float multiplier, Column by) {
#define LESSEN_DIAGONAL(c) \
    if (has(of, c))        \
        joint_equations.at[j].diagonal[row + c] = less_multiple(joint_equations.at[j].diagonal[row + c], multiplier, by.at[c]);
    EACH_OF_SIX(LESSEN_DIAGONAL)
}
void lessen_coupling(uint j, uint row, uint of, float multiplier, Column by) {
#define LESSEN_COUPLING(c) \
    if (has(of, c))        \
        joint_equations.at[j].coupling[row + c] = less_multiple(joint_equations.at[j].coupling[row + c], multiplier, by.at[c]);
    EACH_OF_SIX(LESSEN_COUPLING)
}

// Eliminates unknown k of joint j from all later equations.
void eliminate(uint j, uint k) {
    Column own = own_column(j, k);
    float inverse = reciprocal(joint_equations.at[j].diagonal[7u * k]);
    float known = joint_equations.at[j].solution[k];
    joint_equations.at[j].diagonal[7u * k] = inverse;
    uint behind = joints.at[j].solved_axes >> (k + 1u) << (k + 1u);
#define ELIMINATE_OWN(n)                                                                                         \
    if (has(behind, n)) {                                                                                        \
        float multiplier = multiplier_of(own.at[n], inverse);                                                    \
        joint_equations.at[j].solution[n] = less_multiple(joint_equations.at[j].solution[n], multiplier, known); \
        lessen_diagonal(j, 6u * n, behind & UP_TO(n), multiplier, own);                                          \
    }
    EACH_OF_SIX(ELIMINATE_OWN)
    uint fill_in = joints.at[j].fill_in;
    for (uint l = 0u; l < fill_in; ++l) {
        uint i = joints.at[j].fill_in_of[l], theirs = joints.at[i].solved_axes;
        Column pushed = column_of_link(j, l, k);
#define ELIMINATE_LINK(n)                                                                                        \
    if (has(theirs, n)) {                                                                                        \
        float multiplier = multiplier_of(pushed.at[n], inverse);                                                 \
        joint_equations.at[i].solution[n] = less_multiple(joint_equations.at[i].solution[n], multiplier, known); \
        lessen_coupling(j, 36u * l + 6u * n, behind, multiplier, own);                                           \
        lessen_diagonal(i, 6u * n, theirs & UP_TO(n), multiplier, pushed);                                       \
    }
        EACH_OF_SIX(ELIMINATE_LINK)
        for (uint e = 0u; e < l; ++e) {
            uint to = joints.at[j].fill_in_of[e], between = joints.at[to].solved_axes, target = coupling_with(i, to);
            Column other = column_of_link(j, e, k);
#define ELIMINATE_BETWEEN(n) \
    if (has(theirs, n)) lessen_coupling(to, target + 6u * n, between, multiplier_of(pushed.at[n], inverse), other);
            EACH_OF_SIX(ELIMINATE_BETWEEN)
        }
    }
}

void substitute(uint j, uint k) {
    float sum = joint_equations.at[j].solution[k];
    uint own = joints.at[j].solved_axes, fill_in = joints.at[j].fill_in;
#define SUBSTITUTE_OWN(n)     \
    if (n > k && has(own, n)) \
        sum = less_multiple(sum, joint_equations.at[j].diagonal[6u * n + k], joint_equations.at[j].solution[n]);
    EACH_OF_SIX(SUBSTITUTE_OWN)
    for (uint l = 0u; l < fill_in; ++l) {
        uint i = joints.at[j].fill_in_of[l], theirs = joints.at[i].solved_axes;
#define SUBSTITUTE_LINK(n) \
    if (has(theirs, n))    \
        sum = less_multiple(sum, joint_equations.at[j].coupling[36u * l + 6u * n + k], joint_equations.at[i].solution[n]);
        EACH_OF_SIX(SUBSTITUTE_LINK)
    }
    joint_equations.at[j].solution[k] = substituted(sum, joint_equations.at[j].diagonal[7u * k]);
}

void solve_equations(bool biased) {
    for (uint j = block_first_joint; j < block_joints_end; ++j)
        if (holds(j)) set_up_equations(j, biased);
    for (uint j = block_first_joint; j < block_joints_end; ++j)
        for (uint k = 0u; k < 6u; ++k)
            if (holds(j) && unknown(j, k)) eliminate(j, k);
    for (uint j = block_joints_end; j-- > block_first_joint;)
        for (uint k = 6u; k-- > 0u;)
            if (holds(j) && unknown(j, k)) substitute(j, k);
    for (uint j = block_first_joint; j < block_joints_end; ++j)
        for (uint k = 0u; k < 6u; ++k)
            if (holds(j) && unknown(j, k)) push_row(j, k, joint_equations.at[j].solution[k]);
}

// Updates the active set after a solution; true if it changed.
bool look_at_bounds(uint j, bool biased, bool settling) {
    bool others = false;
    VelocityPair v = couple_of(j);
    for (uint k = 0u; k < 6u; ++k) {
        JointAxis axis = joints.at[j].axes[k];
        JointRow row = joints.at[j].rows[k];
        if (!row_acts(axis, row)) continue;
        uint active_flags = active_set_of(joints.at[j].active_set, k);
        bool solved = unknown(j, k);
        float solution = solved ? joint_equations.at[j].solution[k] : 0.0f;
        RowAfter after = row_after_round(axis, row, joints.at[j].rotors[k], k, active_flags, solved, solution,
                                         row_speed(row, is_linear(k), v), biased, settling, PARAMETERS);
        if (has_rotor(axis)) joints.at[j].rotors[k].change = after.rotor_change;
        joints.at[j].rows[k] = after.row;
        if (after.active_flags == active_flags) continue;
        joints.at[j].active_set = with_active_set(joints.at[j].active_set, k, after.active_flags);
        others = true;
    }
    return others;
}

// push.pass: bit 0 in the last substep; from bit 8 the first round of this dispatch, from bit 16 the number of its
// rounds (dispatches_of() in compute/step/stage_fusion.cpp).
uint first_round() {
    return push.pass >> 8 & 255u;
}
uint rounds_end() {
    return first_round() + (push.pass >> 16);
}
bool is_last_dispatch() {
    return rounds_end() >= JOINT_ROUNDS;
}
bool is_last_substep() {
    return (push.pass & 1u) != 0u;
}

void solve_block(bool biased) {
    if (first_round() == 0u) {
        bool after_contacts = biased || is_struck();
        lend(after_contacts);
        take_velocities(after_contacts);
        for (uint j = block_first_joint; j < block_joints_end; ++j) {
            joints.at[j].solved_axes = 0u;
            if (holds(j)) place_rows(j);
        }
        joint_blocks.at[block].unsettled = 1u;
    }
    bool others = joint_blocks.at[block].unsettled != 0u;
    for (uint round = first_round(); round < rounds_end() && others; ++round) {
        restore_velocities();
        for (uint j = block_first_joint; j < block_joints_end; ++j)
            if (holds(j)) choose_unknowns(j, biased);
        solve_equations(biased);
        others = false;
        for (uint j = block_first_joint; j < block_joints_end; ++j)
            if (holds(j) && look_at_bounds(j, biased, round >= SETTLING_ROUND)) others = true;
    }
    joint_blocks.at[block].unsettled = others ? 1u : 0u;
}

// Clears the velocity changes, for whole bodies.
void begin_shares() {
    for (uint m = block_first_body; m < block_bodies_end; ++m) {
        block_bodies.at[m].velocity = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
        block_bodies.at[m].mass.split = 1.0f;
    }
}

// Writes the velocity changes to the bodies' slots.
void hand_out(float weight, bool with_normal_impulse) {
    for (uint m = block_first_body; m < block_bodies_end; ++m)
        if (block_bodies.at[m].slot != NONE)
            slots.at[block_bodies.at[m].slot] =
                velocity_delta(block_bodies.at[m].velocity, weight, with_normal_impulse ? block_bodies.at[m].normal_sum : 0.0f);
}

// Velocity changes by this pass, and by the next warm start if it `warms`, of whole bodies.
void share_out(uint j, bool warms) {
    for (uint k = 0u; k < 6u; ++k) {
        JointRow row = joints.at[j].rows[k];
        if (!row_acts(joints.at[j].axes[k], row)) continue;
        float impulse = handed_impulse(row, joints.at[j].rotors[k], warms);
        if (impulse != 0.0f) push_row(j, k, impulse);
    }
}
void share_out_warm_start(uint j) {
    for (uint k = 0u; k < 6u; ++k) {
        JointRow row = joints.at[j].rows[k];
        if (!row_acts(joints.at[j].axes[k], row)) continue;
        float impulse = row_impulse(row, joints.at[j].rotors[k]);
        if (impulse != 0.0f) push_row(j, k, impulse);
    }
}
void commit(uint j, bool warms) {
    for (uint k = 0u; k < 6u; ++k) {
        joints.at[j].rows[k] = committed(joints.at[j].rows[k]);
        if (has_rotor(joints.at[j].axes[k])) joints.at[j].rotors[k] = rotor_after_pass(joints.at[j].rotors[k], warms);
    }
}

void warm_start_rotors(uint j) {
    for (uint k = 0u; k < 6u; ++k)
        if (has_rotor(joints.at[j].axes[k]))
            joints.at[j].rotors[k] = rotor_slowed(joints.at[j].rotors[k], joints.at[j].rotors[k].impulse);
}
// Clears the impulses of a joint.
void tear(uint j) {
    for (uint k = 0u; k < 6u; ++k) {
        joints.at[j].rows[k] = torn(joints.at[j].rows[k]);
        joints.at[j].rotors[k] = torn_rotor(joints.at[j].rotors[k]);
    }
}

// A joint's linear impulse on B.
vec3 force_impulse(uint j) {
    vec3 sum = vec3(0.0f);
    for (uint k = 0u; k < 3u; ++k)
        if (joints.at[j].axes[k].mode != 0u) sum = sum + row_push(joints.at[j].rows[k], joints.at[j].rotors[k]);
    return sum;
}
// A joint's angular impulse on B.
vec3 torque_impulse(uint j) {
    vec3 sum = vec3(0.0f);
    for (uint k = 3u; k < 6u; ++k)
        if (joints.at[j].axes[k].mode != 0u) sum = sum + row_push(joints.at[j].rows[k], joints.at[j].rotors[k]);
    return sum;
}

// Sums the impulses of the block's joints on each body: their weight in mass splitting.
void note_pressing() {
    for (uint m = block_first_body; m < block_bodies_end; ++m) block_bodies.at[m].normal_sum = 0.0f;
    for (uint j = block_first_joint; j < block_joints_end; ++j) {
        if (!holds(j)) continue;
        float normal_impulse = length3(force_impulse(j));
        if (joints.at[j].block_body_a != NONE)
            block_bodies.at[joints.at[j].block_body_a].normal_sum =
                block_bodies.at[joints.at[j].block_body_a].normal_sum + normal_impulse;
        if (joints.at[j].block_body_b != NONE)
            block_bodies.at[joints.at[j].block_body_b].normal_sum =
                block_bodies.at[joints.at[j].block_body_b].normal_sum + normal_impulse;
    }
}

#endif
