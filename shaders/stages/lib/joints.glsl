// A pass over one block of joints, by one thread: its equations, their elimination, and what its bodies go through.
#ifndef SCREE_STAGES_JOINTS_GLSL
#define SCREE_STAGES_JOINTS_GLSL

#include "shaders/physics/extra/sleep.h"
#include "shaders/physics/solve/joint.h"

uint block_first, block_joints, block_members;

// False if there is no such block, or nothing in it moves.
bool enter_block(uint index) {
    if (index >= PARAMETERS.joint_blocks || COUNTS.overflow != 0u) return false;
    block_first = joints.at[index].first_of_block;
    block_joints = block_first + joints.at[block_first].block_joints;
    block_members = block_first + joints.at[block_first].block_members;
    for (uint m = block_first; m < block_members; ++m)
        if (joints.at[m].slot != NONE) return true;
    return false;
}

bool holds(uint j) {
    return joints.at[j].broken == 0u;
}

Pose pose_of(uint body) {
    if (body != NONE) return poses.at[body];
    return Pose(vec3(0.0f), 0.0f, vec4(0.0f, 0.0f, 0.0f, 1.0f));
}
Velocity velocity_of(uint body, uint member) {
    if (member != NONE) return joints.at[member].velocity;
    if (body != NONE) return velocities.at[body];
    return Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
}
Couple couple_of(uint j) {
    Couple v;
    v.a = velocity_of(joints.at[j].a, joints.at[j].member_a);
    v.b = velocity_of(joints.at[j].b, joints.at[j].member_b);
    return v;
}

// In the biased pass, joints come after the contacts, and only blocks share a body. In the one without, it is shared with the
// contacts, and if it is struck among those who strike it.
void lend(bool biased) {
    for (uint m = block_first; m < block_members; ++m) {
        uint body = joints.at[m].member;
        Mass mass = masses.at[body];
        if (biased)
            mass.split = larger(1.0f, float(joints.at[m].blocks) * PARAMETERS.inverse_relaxation);
        else if (loads.at[body].blows > 1.0f)
            mass.split = loads.at[body].blows;
        else
            mass.split = split_for(mass.split, joints.at[m].pressed, PARAMETERS);
        if (joints.at[m].slot == NONE) {
            mass = Mass(0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, mass.split);
        }
        joints.at[m].mass = mass;
    }
}

// `biased`: with what the contacts have just done to them, which is in the slots before those of the blocks.
void begin_velocities(bool biased) {
    for (uint m = block_first; m < block_members; ++m) {
        uint body = joints.at[m].member;
        Velocity velocity = velocities.at[body];
        if (biased && joints.at[m].slot != NONE) {
            uint last = WORD(slot_ends, body) - joints.at[m].blocks;
            for (uint k = body == 0u ? 0u : WORD(slot_ends, body - 1u); k < last; ++k) {
                velocity.linear = velocity.linear + slots.at[k].linear;
                velocity.angular = velocity.angular + slots.at[k].angular;
            }
        }
        joints.at[m].velocity = velocity;
    }
}

void place_rows(uint j) {
    uint a = joints.at[j].a, b = joints.at[j].b;
    JointPlace at = joint_place(joints.at[j].anchor_a, joints.at[j].frame_a, pose_of(a), joints.at[j].anchor_b,
                                joints.at[j].frame_b, pose_of(b));
    Couple v = couple_of(j);
    uint flags = joints.at[j].flags;
    uint side_a = joints.at[j].member_a, side_b = joints.at[j].member_b;
    for (uint k = 0u; k < 6u; ++k) {
        if (joints.at[j].axes[k].mode == 0u) continue;
        JointRow row = joints.at[j].rows[k];
        bool linear = is_linear(k);
        if (linear)
            row = linear_row(row, at, k, flags, v, PARAMETERS.h);
        else
            row = angular_row(row, at, k - 3u, flags, v, PARAMETERS.h);
        float give = 0.0f;
        if (side_a != NONE)
            give = give_between(row.direction, row.arm_a, row.direction, row.arm_a, linear, joints.at[side_a].mass);
        if (side_b != NONE) {
            float give_b = give_between(row.direction, row.arm_b, row.direction, row.arm_b, linear, joints.at[side_b].mass);
            give = side_a != NONE ? give + give_b : give_b;
        }
        row.give = give;
        row.drive_change = 0.0f;
        row.stop_change = 0.0f;
        joints.at[j].rows[k] = row;
    }
}

void push_row(uint j, uint k, float impulse) {
    JointRow row = joints.at[j].rows[k];
    uint side_a = joints.at[j].member_a, side_b = joints.at[j].member_b;
    bool linear = is_linear(k);
    if (side_a != NONE)
        joints.at[side_a].velocity =
            row_pushed(joints.at[side_a].velocity, row.direction, row.arm_a, -impulse, linear, joints.at[side_a].mass);
    if (side_b != NONE)
        joints.at[side_b].velocity =
            row_pushed(joints.at[side_b].velocity, row.direction, row.arm_b, impulse, linear, joints.at[side_b].mass);
}

// Which axes are unknowns; the others' impulses are given, and act at once.
void choose_unknowns(uint j, bool biased) {
    uint unknowns = 0u;
    uint pins = joints.at[j].pins;
    Couple v;
    v.a = velocity_of(NONE, NONE);
    v.b = v.a;
    if (joints.at[j].a != NONE) v.a = velocities.at[joints.at[j].a];
    if (joints.at[j].b != NONE) v.b = velocities.at[joints.at[j].b];
    for (uint k = 0u; k < 6u; ++k) {
        JointAxis axis = joints.at[j].axes[k];
        JointRow row = joints.at[j].rows[k];
        if (axis.mode == 0u || row.give <= 0.0f) continue;
        uint pin = pins_of(pins, k);
        row.drive_change = 0.0f;
        row.stop_change = 0.0f;
        bool stopped = (pin & (STOP_LOW | STOP_HIGH)) != 0u;
        bool driven = drive_is_solved(axis, row, pin, biased, PARAMETERS);
        if (stopped || driven) unknowns |= 1u << k;
        if (!stopped) row.stop_change = -row.stop;
        if (!driven)
            row.drive_change = held_drive(axis, row, pin, row_speed(row, is_linear(k), v), biased, PARAMETERS) - row.drive;
        joints.at[j].rows[k] = row;
        float given = row.drive_change + row.stop_change;
        if (given != 0.0f) push_row(j, k, given);
    }
    joints.at[j].solved = unknowns;
}

bool unknown(uint j, uint k) {
    return (joints.at[j].solved >> k & 1u) != 0u;
}

Demand demand_of(uint j, uint k, bool biased) {
    uint pin = pins_of(joints.at[j].pins, k);
    if ((pin & (STOP_LOW | STOP_HIGH)) != 0u)
        return stop_demand(joints.at[j].axes[k], joints.at[j].rows[k], k, (pin & STOP_LOW) != 0u, biased, PARAMETERS);
    return drive_demand(joints.at[j].axes[k], joints.at[j].rows[k], k, biased, PARAMETERS);
}

// What row k of joint j does to row n of joint i, through the bodies that they share.
float between(uint i, uint n, uint j, uint k) {
    JointRow left = joints.at[i].rows[n], right = joints.at[j].rows[k];
    bool linear = is_linear(n) && is_linear(k);
    float sum = 0.0f;
    bool any = false;
    for (uint s = 0u; s < 4u; ++s) {
        bool left_is_b = s >= 2u, right_is_b = (s & 1u) != 0u;
        uint member = left_is_b ? joints.at[i].member_b : joints.at[i].member_a;
        if (member == NONE || member != (right_is_b ? joints.at[j].member_b : joints.at[j].member_a)) continue;
        float give = give_between(left.direction, left_is_b ? left.arm_b : left.arm_a, right.direction,
                                  right_is_b ? right.arm_b : right.arm_a, linear, joints.at[member].mass);
        if (left_is_b != right_is_b) give = -give;
        sum = any ? sum + give : give;
        any = true;
    }
    return sum;
}

void set_up_equations(uint j, bool biased) {
    Couple v = couple_of(j);
    for (uint k = 0u; k < 6u; ++k) {
        if (!unknown(j, k)) continue;
        Demand demand = demand_of(j, k, biased);
        joints.at[j].solution[k] = -(row_speed(joints.at[j].rows[k], is_linear(k), v) + demand.bias);
        for (uint n = k; n < 6u; ++n)
            if (unknown(j, n)) joints.at[j].diagonal[6u * n + k] = between(j, n, j, k);
        joints.at[j].diagonal[7u * k] = joints.at[j].diagonal[7u * k] + demand.compliance;
        for (uint l = 0u; l < joints.at[j].links; ++l) {
            uint i = joints.at[j].links_to[l];
            for (uint n = 0u; n < 6u; ++n)
                if (unknown(i, n)) joints.at[j].coupling[36u * l + 6u * n + k] = between(i, n, j, k);
        }
    }
}

// Where joint j keeps its coupling with joint i.
uint coupling_with(uint i, uint j) {
    uint l = 0u;
    while (l + 1u < joints.at[j].links && joints.at[j].links_to[l] != i) ++l;
    return 36u * l;
}

// Takes unknown k of joint j out of all equations behind it.
void eliminate(uint j, uint k) {
    float inverse = reciprocal(joints.at[j].diagonal[7u * k]);
    float known = joints.at[j].solution[k];
    joints.at[j].diagonal[7u * k] = inverse;
    for (uint n = k + 1u; n < 6u; ++n) {
        if (!unknown(j, n)) continue;
        float part = joints.at[j].diagonal[6u * n + k] * inverse;
        joints.at[j].solution[n] = joints.at[j].solution[n] - part * known;
        for (uint c = k + 1u; c <= n; ++c)
            if (unknown(j, c))
                joints.at[j].diagonal[6u * n + c] = joints.at[j].diagonal[6u * n + c] - part * joints.at[j].diagonal[6u * c + k];
    }
    uint links = joints.at[j].links;
    for (uint l = 0u; l < links; ++l) {
        uint i = joints.at[j].links_to[l];
        for (uint n = 0u; n < 6u; ++n) {
            if (!unknown(i, n)) continue;
            uint row = 36u * l + 6u * n;
            float part = joints.at[j].coupling[row + k] * inverse;
            joints.at[i].solution[n] = joints.at[i].solution[n] - part * known;
            for (uint c = k + 1u; c < 6u; ++c)
                if (unknown(j, c))
                    joints.at[j].coupling[row + c] = joints.at[j].coupling[row + c] - part * joints.at[j].diagonal[6u * c + k];
            for (uint c = 0u; c <= n; ++c)
                if (unknown(i, c))
                    joints.at[i].diagonal[6u * n + c] =
                        joints.at[i].diagonal[6u * n + c] - part * joints.at[j].coupling[36u * l + 6u * c + k];
            for (uint e = 0u; e < l; ++e) {
                uint to = joints.at[j].links_to[e];
                uint target = coupling_with(i, to) + 6u * n;
                for (uint c = 0u; c < 6u; ++c)
                    if (unknown(to, c))
                        joints.at[to].coupling[target + c] =
                            joints.at[to].coupling[target + c] - part * joints.at[j].coupling[36u * e + 6u * c + k];
            }
        }
    }
}

void substitute(uint j, uint k) {
    float sum = joints.at[j].solution[k];
    for (uint n = k + 1u; n < 6u; ++n)
        if (unknown(j, n)) sum = sum - joints.at[j].diagonal[6u * n + k] * joints.at[j].solution[n];
    for (uint l = 0u; l < joints.at[j].links; ++l) {
        uint i = joints.at[j].links_to[l];
        for (uint n = 0u; n < 6u; ++n)
            if (unknown(i, n)) sum = sum - joints.at[j].coupling[36u * l + 6u * n + k] * joints.at[i].solution[n];
    }
    joints.at[j].solution[k] = sum * joints.at[j].diagonal[7u * k];
}

void solve_equations(bool biased) {
    for (uint j = block_first; j < block_joints; ++j)
        if (holds(j)) set_up_equations(j, biased);
    for (uint j = block_first; j < block_joints; ++j)
        for (uint k = 0u; k < 6u; ++k)
            if (holds(j) && unknown(j, k)) eliminate(j, k);
    for (uint j = block_joints; j-- > block_first;)
        for (uint k = 6u; k-- > 0u;)
            if (holds(j) && unknown(j, k)) substitute(j, k);
    for (uint j = block_first; j < block_joints; ++j)
        for (uint k = 0u; k < 6u; ++k)
            if (holds(j) && unknown(j, k)) push_row(j, k, joints.at[j].solution[k]);
}

// Whether another bound acts than was thought.
bool look_at_bounds(uint j, bool biased, bool settling) {
    bool others = false;
    Couple v = couple_of(j);
    for (uint k = 0u; k < 6u; ++k) {
        JointAxis axis = joints.at[j].axes[k];
        JointRow row = joints.at[j].rows[k];
        if (axis.mode == 0u || row.give <= 0.0f) continue;
        uint pin = pins_of(joints.at[j].pins, k);
        bool solved = unknown(j, k);
        float solution = solved ? joints.at[j].solution[k] : 0.0f;
        joints.at[j].rows[k] = row_after(row, axis, pin, solved, solution, PARAMETERS);
        uint now = pins_after(axis, row, k, pin, solved, solution, row_speed(row, is_linear(k), v), biased, settling, PARAMETERS);
        if (now == pin) continue;
        joints.at[j].pins = with_pins(joints.at[j].pins, k, now);
        others = true;
    }
    return others;
}

void solve_block(bool biased) {
    lend(biased);
    begin_velocities(biased);
    for (uint j = block_first; j < block_joints; ++j) {
        joints.at[j].solved = 0u;
        if (holds(j)) place_rows(j);
    }
    bool others = true;
    for (uint round = 0u; round < JOINT_ROUNDS && others; ++round) {
        begin_velocities(biased);
        for (uint j = block_first; j < block_joints; ++j)
            if (holds(j)) choose_unknowns(j, biased);
        solve_equations(biased);
        others = false;
        for (uint j = block_first; j < block_joints; ++j)
            if (holds(j) && look_at_bounds(j, biased, round >= SETTLING_ROUND)) others = true;
    }
}

// Empties what the bodies are about to be told.
void begin_shares() {
    for (uint m = block_first; m < block_members; ++m) {
        joints.at[m].velocity = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
        joints.at[m].mass.split = 1.0f;
    }
}

// The changes of this pass (if `changed`) and the next warm start (if `warms`), as whole bodies feel them.
void share_out(uint j, bool changed, bool warms) {
    for (uint k = 0u; k < 6u; ++k) {
        JointRow row = joints.at[j].rows[k];
        if (joints.at[j].axes[k].mode == 0u || row.give <= 0.0f) continue;
        float impulse = row.drive + row.stop;
        float change = row.drive_change + row.stop_change;
        if (changed) impulse = warms ? (impulse + change) + change : change;
        if (impulse != 0.0f) push_row(j, k, impulse);
    }
}

// What a joint pushes with, on B.
vec3 force_impulse(uint j) {
    vec3 sum = vec3(0.0f);
    for (uint k = 0u; k < 3u; ++k)
        if (joints.at[j].axes[k].mode != 0u)
            sum = sum + joints.at[j].rows[k].direction * (joints.at[j].rows[k].drive + joints.at[j].rows[k].stop);
    return sum;
}
vec3 torque_impulse(uint j) {
    vec3 sum = vec3(0.0f);
    for (uint k = 3u; k < 6u; ++k)
        if (joints.at[j].axes[k].mode != 0u)
            sum = sum + joints.at[j].rows[k].direction * (joints.at[j].rows[k].drive + joints.at[j].rows[k].stop);
    return sum;
}

void note_pressing() {
    for (uint m = block_first; m < block_members; ++m) joints.at[m].pressed = 0.0f;
    for (uint j = block_first; j < block_joints; ++j) {
        if (!holds(j)) continue;
        float pressing = length3(force_impulse(j));
        if (joints.at[j].member_a != NONE)
            joints.at[joints.at[j].member_a].pressed = joints.at[joints.at[j].member_a].pressed + pressing;
        if (joints.at[j].member_b != NONE)
            joints.at[joints.at[j].member_b].pressed = joints.at[joints.at[j].member_b].pressed + pressing;
    }
}

#endif
