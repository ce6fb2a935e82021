// Passes over blocks of joints, SCREE_LANES blocks at once. The build compiles this file once per vector width
// (compute/CMakeLists.txt); compute/cpu/simd/simd_dispatch.cpp picks one.
#include "compute/cpu/simd/simd_blocks.h"

// Defines the types of the laws, so before them.
#include "compute/cpu/simd/simd_types.h"

#include "shaders/physics/contact/contact_solver.h"
#include "shaders/physics/joint/joint_matrix.h"
#include "shaders/physics/joint/joint_pass.h"
#undef float
#undef bool

// Use these types.
#include "compute/cpu/simd/block_equations.h"
#include "compute/cpu/simd/block_lanes.h"
#include "compute/cpu/simd/block_rows.h"

LAWS_BEGIN

namespace {

// ---- a round
// Chooses the unknowns; the impulses of the other rows are given and applied at once.
void apply_given(Pass& pass, uint32_t j, Bool biased) {
    JointInLanes& joint = pass.joints[j];
    Pushes pushes;
    joint.unknown = 0;
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.used, k)) continue;
        Row& row = joint.rows[k];
        const Uint active_flags = active_set_of(joint.active_set, Uint(k));
        row.unknown = row.acts && row_is_unknown(row.axis, row.row, active_flags, biased, pass.p);
        joint.unknown |= uint32_t{some(row.unknown)} << k;
        const JointRow given = row_given(row.axis, row.row, active_flags, row.speed_before, biased, pass.p);
        row.row.motor_change = choose(row.acts, given.motor_change, row.row.motor_change);
        row.row.limit_change = choose(row.acts, given.limit_change, row.row.limit_change);
        const Float impulse = given_push(row.axis, given);
        pushes.add(k, impulse, row.acts && impulse != 0.0f);
    }
    push(pass, j, pushes);
}

// Right-hand sides and compliances.
void demand(Pass& pass, uint32_t j, Bool biased) {
    JointInLanes& joint = pass.joints[j];
    const VelocityPair v = velocities_of(pass, j);
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.unknown, k)) continue;
        Row& row = joint.rows[k];
        const Uint active_flags = active_set_of(joint.active_set, Uint(k));
        const RowTarget wants = row_demand(row.axis, row.row, row.rotor, Uint(k), active_flags, biased, pass.p);
        const Float speed = row_speed(row.row, is_linear(Uint(k)), v);
        row.solution = only(row.unknown, right_hand_side(speed, wants.bias));
        row.compliance = wants.compliance;
    }
}

void push_solution(Pass& pass, uint32_t j) {
    const JointInLanes& joint = pass.joints[j];
    Pushes pushes;
    for (int k = 0; k < 6; ++k)
        if (has(joint.unknown, k)) pushes.add(k, joint.rows[k].solution, joint.rows[k].unknown);
    push(pass, j, pushes);
}

// Whether an active set changed.
Bool other_bounds(Pass& pass, uint32_t j, Bool biased, Bool settling) {
    JointInLanes& joint = pass.joints[j];
    const VelocityPair v = velocities_of(pass, j);
    const Uint before = joint.active_set;
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.used, k)) continue;
        Row& row = joint.rows[k];
        const Uint active_flags = active_set_of(before, Uint(k));
        const Float solution = has(joint.unknown, k) ? row.solution : Float(0.0f);
        const Float speed = row_speed(row.row, is_linear(Uint(k)), v);
        const RowAfter after = row_after_round(row.axis, row.row, row.rotor, Uint(k), active_flags, row.unknown, solution, speed,
                                               biased, settling, pass.p);
        row.row.motor_change = choose(row.acts, after.row.motor_change, row.row.motor_change);
        row.row.limit_change = choose(row.acts, after.row.limit_change, row.row.limit_change);
        row.rotor.change = choose(row.acts && has_rotor(row.axis), after.rotor_change, row.rotor.change);
        joint.active_set = choose(row.acts, with_active_set(joint.active_set, Uint(k), after.active_flags), joint.active_set);
    }
    return joint.active_set != before;
}

bool all_finite(const JointInLanes& joint) {
    Bool finite = true;
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.used, k)) continue;
        const Row& row = joint.rows[k];
        finite = finite && (!row.used || is_finite(handed_impulse(row.row, row.rotor, true)));
    }
    return none(!finite);
}

// A block whose active set no longer changes gives the same in further rounds, which others need. False: not finite, where bits
// of lanes and of single blocks may differ.
SCREE_INLINE bool solve_rounds(Pass& pass, Bool biased) {
    const BlockShape& shape = pass.group.shape;
    Bool others = true;
    for (int round = 0; round < reference::joint_rounds && some(others); ++round) {
        for (uint32_t m = 0; m < shape.bodies; ++m) pass.members[m].velocity = pass.members[m].before;
        for (uint32_t j = 0; j < shape.joints; ++j) apply_given(pass, j, biased);
        for (uint32_t j = 0; j < shape.joints; ++j) demand(pass, j, biased);
        if (!solve_equations(pass)) return false;
        for (uint32_t j = 0; j < shape.joints; ++j) push_solution(pass, j);
        others = false;
        for (uint32_t j = 0; j < shape.joints; ++j)
            others = others || other_bounds(pass, j, biased, Bool(round >= reference::settling_round));
    }
    for (size_t lane = 0; lane < lanes && lane < pass.group.count; ++lane) pass.group.unsettled[lane] = others.v[lane] != 0;
    for (uint32_t j = 0; j < shape.joints; ++j)
        if (!all_finite(pass.joints[j])) return false;
    return true;
}

// ---- a pass ends
// The whole bodies' velocity changes by the impulses handed out.
void gather_joint(Pass& pass, uint32_t j, Bool warms) {
    const JointInLanes& joint = pass.joints[j];
    Pushes pushes;
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.used, k)) continue;
        const Float impulse = handed_impulse(joint.rows[k].row, joint.rows[k].rotor, warms);
        pushes.add(k, impulse, joint.rows[k].acts && impulse != 0.0f);
    }
    push(pass, j, pushes);
}
void commit(JointInLanes& joint, Bool warms) {
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.used, k)) continue;
        Row& row = joint.rows[k];
        row.row = committed(row.row);
        if (none(has_rotor(row.axis))) continue;
        const JointRotor after = rotor_after_pass(row.rotor, row.row, warms);
        row.rotor.speed = choose(has_rotor(row.axis), after.speed, row.rotor.speed);
        row.rotor.impulse = choose(has_rotor(row.axis), after.impulse, row.rotor.impulse);
        row.rotor.change = choose(has_rotor(row.axis), after.change, row.rotor.change);
    }
}
void gather_all(Pass& pass, Bool warms) {
    for (uint32_t m = 0; m < pass.group.shape.bodies; ++m) {
        Member& member = pass.members[m];
        member.velocity = {vec3(0.0f), 0.0f, vec3(0.0f), 0.0f};
        member.mass.split = 1.0f;
    }
    for (uint32_t j = 0; j < pass.group.shape.joints; ++j) {
        gather_joint(pass, j, warms);
        commit(pass.joints[j], warms);
    }
}

void write_deltas(const Pass& pass, const Member& member, Float weight, Float normal_sum) {
    Words slots = member.slot.v;
    for (size_t lane = pass.group.count; lane < lanes; ++lane) slots[lane] = nowhere;
    scatter(pass.tables.slots, Indices(Uint(slots)), velocity_delta(member.velocity, weight, normal_sum));
}

SCREE_INLINE vec3 impulse_of(const JointInLanes& joint, int first) {
    vec3 sum(0.0f);
    for (int k = first; k < first + 3; ++k)
        if (has(joint.used, k)) sum = choose(joint.rows[k].used, sum + row_push(joint.rows[k].row, joint.rows[k].rotor), sum);
    return sum;
}
// Adds a joint's impulses to its load, and if it is struck clears them: those of an impact must not warm start.
void take_load(Pass& pass, JointInLanes& joint, Bool struck) {
    Forces load = gather_at<Forces>(joint.record, forces_of_joint);
    load.force = load.force + impulse_of(joint, 0);
    load.torque = load.torque + impulse_of(joint, 3);
    scatter_at(Records(pass, joint.record, joint.holds).at, forces_of_joint, load);
    if (none(struck)) return;
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.used, k)) continue;
        Row& row = joint.rows[k];
        row.row.motor_impulse = choose(struck, 0.0f, row.row.motor_impulse);
        row.row.limit_impulse = choose(struck, 0.0f, row.row.limit_impulse);
        row.rotor.impulse = choose(struck, 0.0f, row.rotor.impulse);
    }
}
void note_pressing(Pass& pass) {
    for (uint32_t m = 0; m < pass.group.shape.bodies; ++m) pass.members[m].normal_sum = 0.0f;
    for (uint32_t j = 0; j < pass.group.shape.joints; ++j) {
        const Float impulse = length3(impulse_of(pass.joints[j], 0));
        const int32_t ends[] = {pass.shape(j).a, pass.shape(j).b};
        for (const int32_t body : ends) {
            if (body < 0) continue;
            Member& member = pass.members[body];
            member.normal_sum = choose(pass.joints[j].holds, member.normal_sum + impulse, member.normal_sum);
        }
    }
    for (uint32_t m = 0; m < pass.group.shape.bodies; ++m)
        for (size_t lane = 0; lane < lanes && lane < pass.group.count; ++lane)  // of words: clang casts lane 0 of floats
            pass.members[m].record[lane][3] = floatBitsToUint(pass.members[m].normal_sum).v[lane];
}
// Also of rows that no longer constrain.
void clear_impulses(const Pass& pass, Bool struck) {
    for (uint32_t j = 0; j < pass.group.shape.joints; ++j) {
        const Records records(pass, pass.joints[j].record, struck && pass.joints[j].holds);
        for (uint32_t* const record : records.at)
            for (int k = 0; record != nullptr && k < 6; ++k)
                record[impulses_at(k)] = record[impulses_at(k) + 1] = record[rotor_at(k) + 2] = 0;
    }
}
void write(const Pass& pass) {
    for (uint32_t m = 0; m < pass.group.shape.bodies; ++m) write_member(pass, pass.members[m]);
    for (uint32_t j = 0; j < pass.group.shape.joints; ++j) write_joint(pass, pass.joints[j]);
}

// ---- passes
SCREE_INLINE void begin(Pass& pass, Bool after_contacts) {
    for (uint32_t m = 0; m < pass.group.shape.bodies; ++m) take_member(pass, m, after_contacts);
    for (uint32_t j = 0; j < pass.group.shape.joints; ++j) take_joint(pass, j);
}

bool solve(const TableWords& tables, BlockGroup& group, std::byte* room) {
    Pass pass = pass_in(tables, group, room);
    begin(pass, true);
    if (!solve_rounds(pass, true)) return false;
    gather_all(pass, false);
    write(pass);
    for (uint32_t m = 0; m < group.shape.bodies; ++m) write_deltas(pass, pass.members[m], 0.0f, 0.0f);
    return true;
}

bool relax(const TableWords& tables, BlockGroup& group, std::byte* room, bool last) {
    Pass pass = pass_in(tables, group, room);
    Masks of_struck;
    for (size_t lane = 0; lane < lanes; ++lane) of_struck[lane] = group.struck[lane] ? -1 : 0;
    const Bool struck(of_struck), warms = !struck && Bool(!last);
    begin(pass, struck);
    if (!solve_rounds(pass, false)) return false;
    gather_all(pass, warms);
    for (uint32_t j = 0; j < group.shape.joints; ++j) take_load(pass, pass.joints[j], last ? Bool(false) : struck);
    write(pass);
    if (last) return true;
    if (some(struck)) clear_impulses(pass, struck);
    note_pressing(pass);
    for (uint32_t m = 0; m < group.shape.bodies; ++m) write_deltas(pass, pass.members[m], 1.0f, pass.members[m].normal_sum);
    return true;
}

size_t bytes(const BlockShape& shape) {
    return room_for(shape);
}

}  // namespace

LAWS_END

namespace scree::reference {

#define SCREE_BLOCK_STAGES(count) SCREE_JOINED(wide_block_stages_, count)
const WideBlockStages SCREE_BLOCK_STAGES(SCREE_LANES) = {SCREE_LANES, SCREE_NAMED(SCREE_LANES)::bytes,
                                                         SCREE_NAMED(SCREE_LANES)::solve, SCREE_NAMED(SCREE_LANES)::relax};

}  // namespace scree::reference
