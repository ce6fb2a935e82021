// A pass over blocks of joints: rows, equations, elimination, substitution, active set.
//
// A workgroup solves a block. Its threads share the bodies, the joints, the rows of the matrix and, within a pivot joint,
// the rows that its elimination changes; each entry is changed by the pivots in the same order as on the CPU. Compiled
// for blocks of every size, whose equations are in memory, for small ones (SCREE_SMALL_BLOCKS), whose equations are
// shared by the workgroup, and for small ones with a thread a block (SCREE_SINGLY), for software devices, whose threads
// are lanes of a vector: there an array of a thread's own costs least. Blocks with couplings have a shader of their own, whatever
// their size (SCREE_COUPLED).
//
// lavapipe silently ends a shader's loops after 65,535 rounds in all: rounds of a block that would exceed it go to
// further dispatches (compute/plan/stage_fusion.h, which knows how many rounds each loop here takes). Loops are not
// unrolled in the source: drivers took minutes and gigabytes to compile that.
#ifndef SCREE_STAGES_PASS_JOINTS_GLSL
#define SCREE_STAGES_PASS_JOINTS_GLSL

#extension GL_KHR_shader_subgroup_basic : require

#if !defined(SCREE_SMALL_BLOCKS) && !defined(SCREE_SINGLY)
#define SCREE_FUSED  // threads read from memory what others wrote before a barrier
#endif
#include "shaders/physics/base/passes.h"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/joints.glsl"
#ifdef SCREE_COUPLED
#include "shaders/stages/lib/couplings.glsl"
#endif

layout(constant_id = 2) const bool ONE_SUBGROUP = false;

#ifdef SCREE_SMALL_BLOCKS
const uint JOINT_ROOM = SMALL_BLOCK_JOINTS, BODY_ROOM = 2u * SMALL_BLOCK_JOINTS, MASK_WORDS = 1u;
const uint TILE_ROOM = 63u;  // of 11 joints: one of its own and MAX_FILL_IN, as far as joints follow
#elif defined(SCREE_COUPLED)
const uint JOINT_ROOM = MAX_COUPLED_BLOCK, BODY_ROOM = 2u * MAX_COUPLED_BLOCK, MASK_WORDS = 2u;
#else
const uint JOINT_ROOM = MAX_BLOCK_JOINTS, BODY_ROOM = 2u * MAX_BLOCK_JOINTS, MASK_WORDS = MAX_BLOCK_JOINTS >> 5;
#endif

#ifdef SCREE_SINGLY
#define BLOCK_SHARED
#define FOR_LANES(i, count) for (uint i = 0u; i < (count); ++i)
#define JOIN(to, bits) to |= bits
bool leads() {
    return true;
}
void end_part() {}
#else
#define BLOCK_SHARED shared
#define FOR_LANES(i, count) for (uint i = gl_LocalInvocationID.x; i < (count); i += gl_WorkGroupSize.x)
#define JOIN(to, bits) atomicOr(to, bits)
bool leads() {
    return gl_LocalInvocationID.x == 0u;
}
void end_part() {
    if (ONE_SUBGROUP) {
        subgroupMemoryBarrier();
        subgroupBarrier();
    } else {
        memoryBarrierShared();
#ifndef SCREE_SMALL_BLOCKS
        memoryBarrierBuffer();
#endif
        barrier();
    }
}
#endif

// ---- the block: its joints and bodies are numbered from 0
BLOCK_SHARED uint sides[JOINT_ROOM];                 // bodies A and B, 16 bits each
BLOCK_SHARED uint links[2u * JOINT_ROOM];            // later joints whose equations the elimination changes, 8 bits each
BLOCK_SHARED uint facts[JOINT_ROOM];                 // axes in use, number of links from bit 16 on, HOLDS
BLOCK_SHARED uint unknowns[JOINT_ROOM];              // axes that are unknowns
BLOCK_SHARED uint pushing[JOINT_ROOM];               // axes whose impulses are to be applied
BLOCK_SHARED uint hanging[MASK_WORDS * BODY_ROOM];   // joints of each body
BLOCK_SHARED float given_impulses[6u * JOINT_ROOM];  // to be applied; in equations the compliances
BLOCK_SHARED float solutions[6u * JOINT_ROOM];
BLOCK_SHARED float pivots[6u * JOINT_ROOM];  // reciprocals
BLOCK_SHARED uint unsettled;                 // not 0: an active set has changed

const uint NOBODY = 0xFFFFu, HOLDS = 0x80000000u;

// t / 6, of t below 98,304.
uint sixth_of(uint t) {
    return t * 43691u >> 18;
}
bool has(uint axes, uint k) {
    return (axes >> k & 1u) != 0u;
}
bool holds(uint j) {
    return (facts[j] & HOLDS) != 0u;
}
uint axes_of(uint j) {
    return facts[j] & 63u;
}
uint links_of(uint j) {
    return facts[j] >> 16 & 15u;
}
uint link_of(uint j, uint l) {
    return links[2u * j + (l >> 2)] >> (8u * (l & 3u)) & 255u;
}
// The record of a body of the block that this is a side of; NONE: it cannot move.
uint side_a(uint j) {
    uint side = sides[j] & 0xFFFFu;
    return side == NOBODY ? NONE : side;
}
uint side_b(uint j) {
    uint side = sides[j] >> 16;
    return side == NOBODY ? NONE : side;
}

#ifdef SCREE_COUPLED
// A coupling is one of the last joints of the block.
uint first_coupling() {
    return block_joints - joint_blocks.at[block].couplings;
}
bool is_coupling(uint j) {
    return j >= first_coupling();
}
#endif

// ---- what small blocks keep with their threads, and others in memory
#ifdef SCREE_SMALL_BLOCKS
BLOCK_SHARED uint first_tiles[JOINT_ROOM];
BLOCK_SHARED float tiles[36u * TILE_ROOM];
BLOCK_SHARED float rows[90u * JOINT_ROOM];
BLOCK_SHARED float states[14u * BODY_ROOM];  // Velocity and Mass, without padding

uint tile_at(uint j, uint slot) {
    return 36u * (first_tiles[j] + slot);
}
#define TILE(j, x) tiles[x]
#define ROWS(j, x) rows[90u * (j) + (x)]

vec3 three_of(uint at) {
    return vec3(states[at], states[at + 1u], states[at + 2u]);
}
void put_three(uint at, vec3 v) {
    states[at] = v.x;
    states[at + 1u] = v.y;
    states[at + 2u] = v.z;
}
Velocity velocity_now(uint m) {
    return Velocity(three_of(14u * m), 0.0f, three_of(14u * m + 3u), 0.0f);
}
void put_velocity(uint m, Velocity v) {
    put_three(14u * m, v.linear);
    put_three(14u * m + 3u, v.angular);
}
Mass mass_now(uint m) {
    uint at = 14u * m + 6u;
    return Mass(states[at], states[at + 1u], states[at + 2u], states[at + 3u], states[at + 4u], states[at + 5u], states[at + 6u],
                states[at + 7u]);
}
void put_mass(uint m, Mass mass) {
    uint at = 14u * m + 6u;
    states[at] = mass.xx;
    states[at + 1u] = mass.xy;
    states[at + 2u] = mass.xz;
    states[at + 3u] = mass.yy;
    states[at + 4u] = mass.yz;
    states[at + 5u] = mass.zz;
    states[at + 6u] = mass.inverse_mass;
    states[at + 7u] = mass.split;
}
#else
uint tile_at(uint j, uint slot) {
    return 36u * slot;
}
#define TILE(j, x) joint_equations.at[block_first_joint + (j)].tiles[x]
#define ROWS(j, x) joint_equations.at[block_first_joint + (j)].rows[x]

Velocity velocity_now(uint m) {
    return block_bodies.at[block_first_body + m].velocity;
}
void put_velocity(uint m, Velocity v) {
    block_bodies.at[block_first_body + m].velocity = v;
}
Mass mass_now(uint m) {
    return block_bodies.at[block_first_body + m].mass;
}
void put_mass(uint m, Mass mass) {
    block_bodies.at[block_first_body + m].mass = mass;
}
#endif

// Vectors of row k of a joint, in world axes: its direction, the angular parts, and what they do to the bodies' turning.
const uint DIRECTION = 0u, ANGULAR_A = 3u, ANGULAR_B = 6u, TURN_A = 9u, TURN_B = 12u;
vec3 row_vector(uint j, uint k, uint which) {
    uint at = 15u * k + which;
    return vec3(ROWS(j, at), ROWS(j, at + 1u), ROWS(j, at + 2u));
}
void put_row_vector(uint j, uint k, uint which, vec3 v) {
    uint at = 15u * k + which;
    ROWS(j, at) = v.x;
    ROWS(j, at + 1u) = v.y;
    ROWS(j, at + 2u) = v.z;
}

#define JOINT(j) joints.at[block_first_joint + (j)]
#define MEMBER(m) block_bodies.at[block_first_body + (m)]

#ifdef SCREE_COUPLED
// Couplings are joints with one row, the first: the laws treat it like those of joints.
BLOCK_SHARED uint is_unknown[MAX_COUPLED_BLOCK];  // coupling's row in the equations of this round, by joint of the block

// The axis by which the laws tell lengths from angles.
uint kind_of_row(uint j, uint k) {
    return is_coupling(j) ? axis_of_term(term_of(block_first_joint + j, 0u)) : k;
}
uint solved_axes_of(uint j) {
    return is_coupling(j) ? is_unknown[j] : unknowns[j];
}
#else
#define kind_of_row(j, k) k
#define solved_axes_of(j) unknowns[j]
#endif

// Of a lock the laws look at the coordinate of rest alone.
JointAxis axis_of(uint j, uint k) {
    JointAxis axis;
#ifdef SCREE_COUPLED
    if (is_coupling(j)) return axis_of_coupling(JOINT(j).axes[0], JOINT(j).flags);
#endif
    axis.mode = JOINT(j).axes[k].mode;
    axis.lower = axis.upper = axis.stiffness = axis.damping = axis.rest = axis.speed = axis.most = 0.0f;
    if (is_locked(axis))
        axis.rest = JOINT(j).axes[k].rest;
    else if (axis.mode != 0u)
        axis = JOINT(j).axes[k];
    if (k == 3u && axis.mode != 0u) axis = axis_after_turns(axis, JOINT(j).twist, JOINT(j).rows[k].coordinate);
    return axis;
}
JointRotor rotor_of(uint j, uint k, JointAxis axis) {
    JointRotor rotor;
    rotor.inertia = rotor.speed = rotor.impulse = rotor.change = 0.0f;
    if (has_rotor(axis)) rotor = JOINT(j).rotors[k];
    return rotor;
}
// A row without its vectors, and without the changes.
JointRow row_of(uint j, uint k) {
    JointRow row;
    row.direction = row.angular_a = row.angular_b = vec3(0.0f);
    row.coordinate = JOINT(j).rows[k].coordinate;
    row.drift = JOINT(j).rows[k].drift;
    row.inverse_effective_mass = JOINT(j).rows[k].inverse_effective_mass;
    row.motor_impulse = JOINT(j).rows[k].motor_impulse;
    row.limit_impulse = JOINT(j).rows[k].limit_impulse;
    row.motor_change = row.limit_change = 0.0f;
    return row;
}
JointRow row_with_changes(uint j, uint k) {
    JointRow row = row_of(j, k);
    row.motor_change = JOINT(j).rows[k].motor_change;
    row.limit_change = JOINT(j).rows[k].limit_change;
    return row;
}
void put_changes(uint j, uint k, JointRow row) {
    JOINT(j).rows[k].motor_change = row.motor_change;
    JOINT(j).rows[k].limit_change = row.limit_change;
}
float speed_of(uint j, uint k, VelocityPair v) {
    JointRow row = row_of(j, k);
    row.direction = row_vector(j, k, DIRECTION);
    row.angular_a = row_vector(j, k, ANGULAR_A);
    row.angular_b = row_vector(j, k, ANGULAR_B);
    return row_speed(row, is_linear(k), v);
}
#ifdef SCREE_COUPLED
float speed_of_coupling(uint g, bool before);
// `before`: as the pass begins, in place of now; `v`: likewise.
float speed_in(uint j, uint k, VelocityPair v, bool before) {
    if (is_coupling(j)) return speed_of_coupling(j, before);
    return speed_of(j, k, v);
}
#else
#define speed_in(j, k, v, before) speed_of(j, k, v)
#endif
Velocity velocity_of_side(uint body, uint side) {
    if (side != NONE) return velocity_now(side);
    return velocity_at_first(body);
}
VelocityPair couple_of(uint j) {
    VelocityPair v;
    v.a = velocity_of_side(JOINT(j).a, side_a(j));
    v.b = velocity_of_side(JOINT(j).b, side_b(j));
    return v;
}
Mass mass_of_side(uint side) {
    if (side != NONE) return mass_now(side);
    return Mass(0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
}

// ---- a pass begins
void describe_block() {
    FOR_LANES(i, MASK_WORDS * block_size) hanging[i] = 0u;
    end_part();
    FOR_LANES(j, block_joints) {
        uint a = JOINT(j).block_body_a, b = JOINT(j).block_body_b, count = JOINT(j).fill_in;
        a = a == NONE ? NOBODY : a - block_first_body;
        b = b == NONE ? NOBODY : b - block_first_body;
        sides[j] = a | b << 16;
        facts[j] = axes_in_use(block_first_joint + j) | count << 16 | (JOINT(j).broken == 0u ? HOLDS : 0u);
        links[2u * j] = links[2u * j + 1u] = 0u;
        for (uint l = 0u; l < count; ++l)
            links[2u * j + (l >> 2)] |= (JOINT(j).fill_in_of[l] - block_first_joint) << (8u * (l & 3u));
        if (a != NOBODY) JOIN(hanging[MASK_WORDS * a + (j >> 5)], 1u << (j & 31u));
        if (b != NOBODY) JOIN(hanging[MASK_WORDS * b + (j >> 5)], 1u << (j & 31u));
        unknowns[j] = 0u;
#ifdef SCREE_COUPLED
        is_unknown[j] = 0u;
        if (is_coupling(j)) facts[j] = (facts[j] & ~63u) | (is_whole(block_first_joint + j) ? 1u : 0u);
#endif
    }
#ifdef SCREE_SMALL_BLOCKS
    end_part();
    FOR_LANES(j, block_joints) {
        uint first = j;
        for (uint i = 0u; i < j; ++i) first += links_of(i);
        first_tiles[j] = first;
    }
#endif
}

// Whether a body of the block has an impact in this substep: then joints are relaxed after the contacts as well.
bool is_struck() {
    bool struck = false;
    for (uint m = 0u; m < block_size && !struck; ++m) struck = forces.at[MEMBER(m).body].impact_weight != 0.0f;
    return struck;
}

// Masses and velocities of the block's bodies; after the contacts with this pass's changes by them, in the slots before
// those of joints.
void take_bodies(bool after_contacts) {
    FOR_LANES(m, block_size) {
        put_mass(m, lent_mass(block_first_body + m, after_contacts));
        uint body = MEMBER(m).body;
        Velocity velocity = velocities.at[body];
        if (after_contacts && MEMBER(m).slot != NONE) {
            uint last = WORD(slot_ends, body) - MEMBER(m).blocks;
            for (uint k = body == 0u ? 0u : WORD(slot_ends, body - 1u); k < last; ++k)
                velocity = changed_by(velocity, slots.at[k]);
        }
        MEMBER(m).velocity_before = velocity;
        put_velocity(m, velocity);
    }
}

// Jacobian rows of a joint at the present poses.
void place_rows(uint j) {
    JointConfiguration at = configuration_of(block_first_joint + j);
    JOINT(j).twist = at.turned;
    VelocityPair v = couple_of(j);
    uint flags = JOINT(j).flags;
    Mass mass_a = mass_of_side(side_a(j)), mass_b = mass_of_side(side_b(j));
    bool has_a = side_a(j) != NONE, has_b = side_b(j) != NONE;
    FOR_AXES (k, axes_of(j)) {
        float inertia = 0.0f;
        if ((JOINT(j).axes[k].mode & AXIS_ROTOR) != 0u) inertia = JOINT(j).rotors[k].inertia;
        JointRow row;
        row.motor_impulse = JOINT(j).rows[k].motor_impulse;
        row.limit_impulse = JOINT(j).rows[k].limit_impulse;
        row = placed_row(row, at, int(k), flags, v, mass_a, mass_b, has_a, has_b, inertia, PARAMETERS.h);
        JOINT(j).rows[k] = row;
        put_row_vector(j, k, DIRECTION, row.direction);
        put_row_vector(j, k, ANGULAR_A, row.angular_a);
        put_row_vector(j, k, ANGULAR_B, row.angular_b);
        put_row_vector(j, k, TURN_A, turned_by(mass_a, row.angular_a));
        put_row_vector(j, k, TURN_B, turned_by(mass_b, row.angular_b));
    }
}

// ---- impulses
// Applies `given_impulses` of the axes `pushing` to the bodies, each body's in the order of the joints.
const uint FROM_BEFORE = 0u, FROM_NOW = 1u, FROM_REST = 2u;
void push_bodies(uint from) {
    FOR_LANES(m, block_size) {
        Velocity v = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
        Mass mass = mass_now(m);
        if (from == FROM_REST) {  // whole bodies
            mass.split = 1.0f;
            put_mass(m, mass);
        } else if (from == FROM_NOW) {
            v = velocity_now(m);
        } else {
            v = MEMBER(m).velocity_before;
        }
        for (uint w = 0u; w < MASK_WORDS; ++w) {
            uint left = hanging[MASK_WORDS * m + w];
            while (left != 0u) {
                uint j = 32u * w + uint(findLSB(left)), axes = pushing[j];
                bool is_a = side_a(j) == m, is_b = side_b(j) == m;
                left &= left - 1u;
                FOR_AXES (k, axes) {
                    vec3 direction = row_vector(j, k, DIRECTION);
                    float impulse = given_impulses[6u * j + k];
                    if (is_a) v = row_turned(v, direction, row_vector(j, k, TURN_A), -impulse, is_linear(k), mass);
                    if (is_b) v = row_turned(v, direction, row_vector(j, k, TURN_B), impulse, is_linear(k), mass);
                }
            }
        }
        put_velocity(m, v);
    }
}

// ---- a round
// Chooses the axes that are unknowns; the impulses of the others are given.
void choose_unknowns(uint j) {
    uint found = 0u, given = 0u, active_set = JOINT(j).active_set;
    FOR_AXES (k, axes_of(j)) {
        JointAxis axis = axis_of(j, k);
        JointRow row = row_of(j, k);
        if (!row_acts(axis, row)) continue;
        uint active_flags = active_set_of(active_set, k);
        if (row_is_unknown(axis, row, active_flags, BIASED, PARAMETERS)) found |= 1u << k;
        float speed = 0.0f;
        if (!motor_is_solved(axis, row, active_flags, BIASED, PARAMETERS)) {
            VelocityPair v;
            v.a = velocity_at_first(JOINT(j).a);
            v.b = velocity_at_first(JOINT(j).b);
            speed = speed_in(j, k, v, true);
        }
        row = row_given(axis, row, active_flags, speed, BIASED, PARAMETERS);
        put_changes(j, k, row);
        float change = given_push(axis, row);
        given_impulses[6u * j + k] = change;
        if (change != 0.0f) given |= 1u << k;
    }
#ifdef SCREE_COUPLED
    if (is_coupling(j)) {
        is_unknown[j] = found;
        found = 0u;
    }
#endif
    unknowns[j] = found;
    pushing[j] = given;
}

// Right-hand sides and compliances.
void set_up_sides(uint j) {
    VelocityPair v = couple_of(j);
    uint active_set = JOINT(j).active_set;
    FOR_AXES (k, solved_axes_of(j)) {
        JointAxis axis = axis_of(j, k);
        RowTarget demand = row_demand(axis, row_with_changes(j, k), rotor_of(j, k, axis), kind_of_row(j, k),
                                      active_set_of(active_set, k), BIASED, PARAMETERS);
        solutions[6u * j + k] = right_hand_side(speed_in(j, k, v, false), demand.bias);
        given_impulses[6u * j + k] = demand.compliance;
    }
}

#include "shaders/stages/lib/joint_equations.glsl"

// Updates the active set after a solution; true if it changed.
bool look_at_bounds(uint j, bool settling) {
    VelocityPair v = couple_of(j);
    uint before = JOINT(j).active_set, active_set = before;
    FOR_AXES (k, axes_of(j)) {
        JointAxis axis = axis_of(j, k);
        JointRow row = row_with_changes(j, k);
        if (!row_acts(axis, row)) continue;
        bool solved = has(solved_axes_of(j), k);
        float solution = 0.0f;
        if (solved) solution = solutions[6u * j + k];
        RowAfter after = row_after_round(axis, row, rotor_of(j, k, axis), kind_of_row(j, k), active_set_of(before, k), solved,
                                         solution, speed_in(j, k, v, false), BIASED, settling, PARAMETERS);
        if (has_rotor(axis)) JOINT(j).rotors[k].change = after.rotor_change;
        put_changes(j, k, after.row);
        active_set = with_active_set(active_set, k, after.active_flags);
    }
    JOINT(j).active_set = active_set;
    return active_set != before;
}

// push.pass: bit 0 in the last substep; from bit 8 the first round of this dispatch, from bit 16 the number of its
// rounds (dispatches_of() in compute/plan/stage_fusion.cpp).
uint first_round() {
#ifdef SCREE_SMALL_BLOCKS
    return 0u;
#else
    return push.pass >> 8 & 255u;
#endif
}
uint rounds_end() {
#ifdef SCREE_SMALL_BLOCKS
    return JOINT_ROUNDS;
#else
    return first_round() + (push.pass >> 16);
#endif
}
bool is_last_substep() {
    return (push.pass & PASS_LAST) != 0u;
}

void solve_block() {
    describe_block();
    if (first_round() == 0u) {
        take_bodies(BIASED || is_struck());
        end_part();
        FOR_LANES(j, block_joints) {
            JOINT(j).solved_axes = 0u;
#ifdef SCREE_COUPLED
            if (is_coupling(j)) continue;
#endif
            if (holds(j)) place_rows(j);
        }
#ifdef SCREE_COUPLED
        end_part();
        FOR_LANES(i, block_joints - first_coupling()) {
            uint coupling = block_first_joint + first_coupling() + i;
            if (is_whole(coupling)) place_coupling(coupling);
        }
#endif
        if (leads()) unsettled = 1u;
    } else if (leads()) {
        unsettled = joint_blocks.at[block].unsettled;
    }
    end_part();
    for (uint round = first_round(); round < rounds_end() && unsettled != 0u; ++round) {
        FOR_LANES(j, block_joints) {
            pushing[j] = 0u;
            if (holds(j)) choose_unknowns(j);
        }
        end_part();
#ifdef SCREE_COUPLED
        if (leads()) pass_on_impulses();
        end_part();
#endif
        push_bodies(FROM_BEFORE);
        end_part();
        solve_equations();
        if (leads()) unsettled = 0u;
        end_part();
        push_bodies(FROM_NOW);
        end_part();
        FOR_LANES(j, block_joints) {
            if (!holds(j)) continue;
            JOINT(j).solved_axes = unknowns[j];
            if (look_at_bounds(j, round >= SETTLING_ROUND)) JOIN(unsettled, 1u);
        }
        end_part();
    }
    if (leads()) joint_blocks.at[block].unsettled = unsettled;
}

// ---- a pass ends
// The impulses that whole bodies get: those of this pass, and of the next warm start if it `warms`. Commits them.
void commit(uint j, bool warms) {
    uint given = 0u;
    FOR_AXES (k, axes_of(j)) {
        JointAxis axis = axis_of(j, k);
        JointRow row = row_with_changes(j, k);
        JointRotor rotor = rotor_of(j, k, axis);
        if (row_acts(axis, row)) {
            float impulse = handed_impulse(row, rotor, warms);
            given_impulses[6u * j + k] = impulse;
            if (impulse != 0.0f) given |= 1u << k;
        }
        row = committed(row);
        JOINT(j).rows[k].motor_impulse = row.motor_impulse;
        JOINT(j).rows[k].limit_impulse = row.limit_impulse;
        if (has_rotor(axis)) JOINT(j).rotors[k] = rotor_after_pass(rotor, row, warms);
    }
    pushing[j] = given;
}

// Velocity changes of whole bodies, in their slots.
void write_deltas(float weight, bool with_normal_impulse) {
    FOR_LANES(m, block_size) {
        Velocity v = velocity_now(m);
#ifdef SCREE_SMALL_BLOCKS
        MEMBER(m).mass = mass_now(m);
        MEMBER(m).velocity = v;
#endif
        if (MEMBER(m).slot != NONE)
            WRITE(slots, MEMBER(m).slot, velocity_delta(v, weight, with_normal_impulse ? MEMBER(m).normal_sum : 0.0f));
    }
}

// Whether a block is of the kind that this shader is for.
bool is_ours(uint index) {
#ifdef SCREE_COUPLED
    return joint_blocks.at[index].couplings != 0u;
#elif defined(SCREE_SMALL_BLOCKS)
    return joint_blocks.at[index].joints <= SMALL_BLOCK_JOINTS && joint_blocks.at[index].couplings == 0u;
#else
    return joint_blocks.at[index].joints > SMALL_BLOCK_JOINTS && joint_blocks.at[index].couplings == 0u;
#endif
}

void end_pass();

void main() {
    if (COUNTS.overflow != 0u) return;
#ifdef SCREE_SINGLY
    uint first = thread(), stride = groups() * gl_WorkGroupSize.x;
#else
    uint first = group(), stride = groups();
#endif
    for (uint index = first; index < PARAMETERS.joint_blocks; index += stride) {
        if (!is_ours(index) || !enter_block(index)) continue;
        solve_block();
        if (rounds_end() >= JOINT_ROUNDS) end_pass();
        end_part();
    }
}

#endif
