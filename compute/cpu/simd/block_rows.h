// Blocks of joints in lanes: their bodies and rows as a pass begins, and what it writes. For compute/cpu/simd/simd_blocks.cpp.
#pragma once

#include "compute/cpu/simd/block_lanes.h"
#include "compute/cpu/simd/joint_placement.h"

LAWS_BEGIN

namespace {

// The first members of a BlockBody, and those that a pass writes.
struct MemberHead {
    Uint body, slot, blocks;
    Float normal_sum;
};
struct MemberState {
    Mass mass;
    Velocity velocity, velocity_before;
};
static_assert(sizeof(MemberHead) + sizeof(MemberState) == sizeof(BlockBody));
constexpr size_t state_of_member = sizeof(MemberHead) / sizeof(Words);

struct JointState {
    Uint active_set, broken, solved_axes;
    Float twist;
};
struct Impulses {  // the last members of a JointRow
    Float motor_impulse, limit_impulse, motor_change, limit_change;
};
struct Forces {
    vec3 force;
    Float max_force;
    vec3 torque;
    Float max_torque;
};
constexpr size_t words_of(size_t bytes) {
    return bytes / sizeof(Words);
}
constexpr size_t axis_at(int k) {
    return words_of(offsetof(Joint, axes) + static_cast<size_t>(k) * sizeof(JointAxis));
}
constexpr size_t rotor_at(int k) {
    return words_of(offsetof(Joint, rotors) + static_cast<size_t>(k) * sizeof(JointRotor));
}
constexpr size_t row_at(int k) {
    return words_of(offsetof(Joint, rows) + static_cast<size_t>(k) * sizeof(JointRow));
}
constexpr size_t impulses_at(int k) {
    return row_at(k) + words_of(offsetof(JointRow, motor_impulse));
}
constexpr size_t state_of_joint = words_of(offsetof(Joint, active_set)), forces_of_joint = words_of(offsetof(Joint, force));

constexpr uint32_t at_rest[8] = {}, pose_of_world[8] = {0, 0, 0, 0, 0, 0, 0, 0x3F800000u};

// ---- bodies
// Adds this pass's changes by contacts, whose slots come before those of joints.
SCREE_INLINE void add_contacts(const TableWords& tables, uint32_t body, uint32_t blocks, uint32_t* words) {
    using Eight [[gnu::vector_size(32)]] = float;
    using EightMasks [[gnu::vector_size(32)]] = int32_t;
    const EightMasks moving{-1, -1, -1, 0, -1, -1, -1, 0};
    Eight velocity, change;
    __builtin_memcpy(&velocity, words, sizeof velocity);
    const uint32_t last = tables.slot_ends[body] - blocks;
    for (uint32_t k = body == 0 ? 0 : tables.slot_ends[body - 1]; k < last; ++k) {
        __builtin_memcpy(&change, tables.slots + size_t{8} * k, sizeof change);
        velocity = moving ? velocity + change : velocity;
    }
    __builtin_memcpy(words, &velocity, sizeof velocity);
}

// `after_contacts`: lanes whose bodies are taken after this pass's changes by contacts, and not shared with them.
SCREE_INLINE void take_member(Pass& pass, uint32_t m, Bool after_contacts) {
    const TableWords& tables = pass.tables;
    Member& member = pass.members[m];
    const uint32_t* head_at[lanes];
    for (size_t lane = 0; lane < lanes; ++lane) {
        head_at[lane] = member.record[lane] =
            tables.block_bodies + words_of(sizeof(BlockBody)) * (pass.group.first_body[lane] + m);
    }
    const MemberHead head = gather_at<MemberHead>(head_at);
    const Indices bodies(head.body);
    member.slot = head.slot;
    member.normal_sum = head.normal_sum;
    member.pose = gather<Pose>(tables.poses, bodies);
    member.first = member.before = gather<Velocity>(tables.velocities, bodies);
    const Bool moves = head.slot != Uint(nowhere);
    member.mass =
        mass_of_member(gather<BodyMass>(tables.masses, bodies), moves, head.blocks, head.normal_sum, after_contacts, pass.p);
    if (none(after_contacts && moves)) return;
    uint32_t velocities[lanes][8];
    const uint32_t* velocity_at[lanes];
    for (size_t lane = 0; lane < lanes; ++lane) {
        __builtin_memcpy(velocities[lane], tables.velocities + size_t{8} * bodies.of[lane], sizeof velocities[lane]);
        velocity_at[lane] = velocities[lane];
        if (after_contacts.v[lane] && moves.v[lane]) add_contacts(tables, bodies.of[lane], head.blocks.v[lane], velocities[lane]);
    }
    member.before = gather_at<Velocity>(velocity_at);
}

// ---- rows at the present poses
SCREE_INLINE Pose pose_of(const Pass& pass, int32_t member, Uint body) {
    if (member >= 0) return pass.members[member].pose;
    const uint32_t* at[lanes];
    for (size_t lane = 0; lane < lanes; ++lane)
        at[lane] = body.v[lane] == nowhere ? pose_of_world : pass.tables.poses + size_t{8} * body.v[lane];
    return gather_at<Pose>(at);
}
SCREE_INLINE Velocity velocity_of(const Pass& pass, int32_t member, Uint body) {
    if (member >= 0) return pass.members[member].before;
    const uint32_t* at[lanes];
    for (size_t lane = 0; lane < lanes; ++lane)
        at[lane] = body.v[lane] == nowhere ? at_rest : pass.tables.velocities + size_t{8} * body.v[lane];
    return gather_at<Velocity>(at);
}

SCREE_INLINE void take_joint(Pass& pass, uint32_t j) {
    const JointShape& shape = pass.shape(j);
    JointInLanes& joint = pass.joints[j];
    for (size_t lane = 0; lane < lanes; ++lane)
        joint.record[lane] = pass.tables.joints + words_of(sizeof(Joint)) * (pass.group.first_joint[lane] + j);
    const Placement placement = gather_at<Placement>(joint.record);
    const JointState state = gather_at<JointState>(joint.record, state_of_joint);
    joint.active_set = state.active_set;
    joint.holds = state.broken == 0u;
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) joint.rows[k].axis = gather_at<JointAxis>(joint.record, axis_at(k));
    const JointConfiguration at =
        turned_configuration(joint_configuration(placement.anchor_a, placement.frame_a, pose_of(pass, shape.a, placement.a),
                                                 placement.anchor_b, placement.frame_b, pose_of(pass, shape.b, placement.b)),
                             placement.flags, state.twist, joint.rows[3].axis, joint.rows[4].axis, joint.rows[5].axis);
    joint.twist = at.turned;
    const VelocityPair v{velocity_of(pass, shape.a, placement.a), velocity_of(pass, shape.b, placement.b)};
    joint.other_a = v.a;
    joint.other_b = v.b;
    const VelocityPair first = first_velocities_of(pass, j);
    const Mass a = mass_of(pass, shape.a), b = mass_of(pass, shape.b);
    joint.used = joint.used_by_all = 0;
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) {
        Row& row = joint.rows[k];
        row.used = joint.holds && row.axis.mode != 0u;
        if (none(row.used)) continue;
        joint.used |= 1u << k;
        joint.used_by_all |= uint32_t{none(!row.used)} << k;
        row.rotor = gather_at<JointRotor>(joint.record, rotor_at(k));
        const Impulses impulses = gather_at<Impulses>(joint.record, impulses_at(k));
        row.row.motor_impulse = impulses.motor_impulse;
        row.row.limit_impulse = impulses.limit_impulse;
        row.row = placed_row(row.row, at, k, placement.flags, v, a, b, shape.a >= 0, shape.b >= 0, row.rotor.inertia, pass.p.h);
        if (k == 3) row.axis = axis_after_turns(row.axis, at.turned, row.row.coordinate);
        row.acts = row.used && row_acts(row.axis, row.row);
        row.turn_a = turned_by(a, row.row.angular_a);
        row.turn_b = turned_by(b, row.row.angular_b);
        row.speed_before = row_speed(row.row, is_linear(Uint(k)), first);
    }
}

// ---- what the pass writes
// Records of the lanes in which `those` holds; else null.
struct Records {
    uint32_t* at[SCREE_LANES];
    SCREE_INLINE Records(const Pass& pass, uint32_t* const* records, Bool those) {
        for (size_t lane = 0; lane < lanes; ++lane) at[lane] = lane < pass.group.count && those.v[lane] ? records[lane] : nullptr;
    }
};

SCREE_INLINE void write_member(const Pass& pass, const Member& member) {
    const Records records(pass, member.record, true);
    scatter_at(records.at, state_of_member, MemberState{member.mass, member.velocity, member.before});
}
SCREE_INLINE void write_joint(const Pass& pass, const JointInLanes& joint) {
    Uint solved_axes = 0u;
    for (int k = 0; k < 6; ++k) {
        if (!has(joint.used, k)) continue;
        const Row& row = joint.rows[k];
        const Records records(pass, joint.record, row.used);
        scatter_at(records.at, row_at(k), row.row);
        if (some(row.used && has_rotor(row.axis)))
            scatter_at(Records(pass, joint.record, row.used && has_rotor(row.axis)).at, rotor_at(k), row.rotor);
        solved_axes = choose(row.unknown, solved_axes | Uint(1u << k), solved_axes);
    }
    for (size_t lane = 0; lane < lanes && lane < pass.group.count; ++lane) {
        uint32_t* const state = joint.record[lane] + state_of_joint;
        state[0] = joint.active_set.v[lane];
        state[2] = solved_axes.v[lane];
        if (joint.holds.v[lane]) state[3] = floatBitsToUint(joint.twist).v[lane];
    }
}

}  // namespace

LAWS_END
