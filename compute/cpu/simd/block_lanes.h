// Blocks of joints in lanes: bodies and rows of as many blocks of equal structure as there are lanes, and impulses on them.
// For compute/cpu/simd/simd_blocks.cpp, after the laws.
#pragma once

LAWS_BEGIN

namespace {

using reference::BlockGroup;
using scree::TableWords;

struct Member {
    Velocity velocity;  // of the split bodies; in the end, the whole bodies' change
    Mass mass;
    Velocity before;  // as a round begins
    Velocity first;   // as the pass begins, without the contacts
    Pose pose;
    Uint slot;
    Float normal_sum;
    uint32_t* record[SCREE_LANES];
};

// An axis of a joint. But for their axes, rows that no block uses are not set.
struct Row {
    JointAxis axis;
    JointRotor rotor;
    JointRow row;
    vec3 turn_a, turn_b;  // I^-1 of the angular parts
    Float speed_before;
    Float solution, compliance, inverse_pivot;
    Bool used;     // the joint holds, and the axis is not free
    Bool acts;     // and it constrains a body that can move
    Bool unknown;  // of the equations of this round
};

struct JointInLanes {
    Row rows[6];
    Velocity other_a, other_b;  // of bodies that no impulse changes
    Uint active_set;
    Float twist;                 // rad, whole turns included
    Bool holds;                  // it is not broken
    uint32_t used, used_by_all;  // bit per axis: by some blocks, by all
    uint32_t unknown, unknown_in_all;
    uint32_t* record[SCREE_LANES];
};

struct Tile {
    Float of[36];  // row n, column k: 6 n + k
};

// The work of a pass.
struct Pass {
    const TableWords& tables;
    BlockGroup& group;
    const Parameters& p;
    Member* members;
    JointInLanes* joints;
    Tile* tiles;

    SCREE_INLINE const JointShape& shape(uint32_t j) const { return group.shape.joint[j]; }
};

SCREE_INLINE size_t room_for(const BlockShape& shape) {
    return sizeof(Parameters) + shape.bodies * sizeof(Member) + shape.joints * sizeof(JointInLanes) + shape.tiles * sizeof(Tile);
}
SCREE_INLINE Pass pass_in(const TableWords& tables, BlockGroup& group, std::byte* room) {
    Parameters* const p = reinterpret_cast<Parameters*>(room);
    Member* const members = reinterpret_cast<Member*>(p + 1);
    JointInLanes* const joints = reinterpret_cast<JointInLanes*>(members + group.shape.bodies);
    broadcast(tables.parameters, *p);
    return {tables, group, *p, members, joints, reinterpret_cast<Tile*>(joints + group.shape.joints)};
}

SCREE_INLINE uint32_t has(uint32_t axes, int k) {
    return axes >> k & 1;
}
SCREE_INLINE Float only(Bool those, Float x) {
    return choose(those, x, 0.0f);
}
SCREE_INLINE bool some(Bool a) {
    return !none(a);
}

SCREE_INLINE Bool is_finite(Float x) {
    return abs(x) < Float(3.0e38f);
}

SCREE_INLINE Mass immovable() {
    const Float zero = 0.0f;
    return {zero, zero, zero, zero, zero, zero, zero, zero};
}

// ---- ends of a joint
SCREE_INLINE Mass mass_of(const Pass& pass, int32_t body) {
    return body >= 0 ? pass.members[body].mass : immovable();
}
SCREE_INLINE VelocityPair velocities_of(const Pass& pass, uint32_t j) {
    const JointShape& shape = pass.shape(j);
    return {shape.a >= 0 ? pass.members[shape.a].velocity : pass.joints[j].other_a,
            shape.b >= 0 ? pass.members[shape.b].velocity : pass.joints[j].other_b};
}
SCREE_INLINE VelocityPair first_velocities_of(const Pass& pass, uint32_t j) {
    const JointShape& shape = pass.shape(j);
    return {shape.a >= 0 ? pass.members[shape.a].first : pass.joints[j].other_a,
            shape.b >= 0 ? pass.members[shape.b].first : pass.joints[j].other_b};
}

// ---- impulses
// Of some rows of a joint on one of its bodies, where `those`.
struct Pushes {
    uint32_t axes = 0, everywhere = 0;  // bit per axis: in some lanes, in all
    Float impulse[6];
    Bool those[6];
    SCREE_INLINE void add(int k, Float by, Bool where) {
        impulse[k] = by;
        those[k] = where;
        axes |= uint32_t{some(where)} << k;
        everywhere |= uint32_t{none(!where)} << k;
    }
};
template <bool is_b>
SCREE_INLINE void push_body(Member& member, const JointInLanes& joint, const Pushes& pushes) {
    Velocity v = member.velocity;
    const Mass mass = member.mass;
    for (uint32_t left = pushes.axes; left != 0; left &= left - 1) {
        const int k = __builtin_ctz(left);
        const Row& row = joint.rows[k];
        const Float impulse = is_b ? pushes.impulse[k] : -pushes.impulse[k];
        const vec3 turn = is_b ? row.turn_b : row.turn_a;
        const Velocity pushed = k < 3 ? row_turned(v, row.row.direction, turn, impulse, true, mass)
                                      : row_turned(v, row.row.direction, turn, impulse, false, mass);
        if (has(pushes.everywhere, k)) {
            v.linear = pushed.linear;
            v.angular = pushed.angular;
        } else {
            v.linear = choose(pushes.those[k], pushed.linear, v.linear);
            v.angular = choose(pushes.those[k], pushed.angular, v.angular);
        }
    }
    member.velocity.linear = v.linear;
    member.velocity.angular = v.angular;
}
void push(Pass& pass, uint32_t j, const Pushes& pushes) {
    if (pushes.axes == 0) return;
    const JointShape& shape = pass.shape(j);
    if (shape.a >= 0) push_body<false>(pass.members[shape.a], pass.joints[j], pushes);
    if (shape.b >= 0) push_body<true>(pass.members[shape.b], pass.joints[j], pushes);
}

}  // namespace

LAWS_END
