// Direct solver for a block of joints (compute/step/joint_blocks.h): one sparse system of linear equations.
//
// (J M^-1 J^T + C) dl = -(J v + bias), without the rows at their bounds. The matrix is symmetric positive definite, and
// two joints have an entry in it only if they share a body. It is factored as L D L^T in the order of the block's
// joints, which causes little fill-in (Baraff, Linear-Time Dynamics using Lagrange Multipliers, SIGGRAPH 1996; Davis,
// Direct Methods for Sparse Linear Systems, 2006, ch. 4 and 7). For mass splitting (contact_solver.h) a block counts as
// one constraint however many joints it has, and a chain carries a hundred times its links' weight without stretching.
#ifndef SCREE_PHYSICS_JOINT_BLOCK_H
#define SCREE_PHYSICS_JOINT_BLOCK_H

#include "shaders/physics/solve/joint_axis.h"
#include "shaders/physics/solve/mass_splitting.h"

LAWS_BEGIN

CONSTANT uint JOINT_ROUNDS = 8u;    // solutions of a block in a pass at most
CONSTANT uint SETTLING_ROUND = 2u;  // then bounds are only released: else some blocks cycle

// ---- split bodies
// The split mass of a body of the block. In the biased pass, and in the relax pass of a block that is struck, joints are
// solved after the contacts, and only blocks share the body; else contacts share it as well.
LAW Mass mass_of_member(Mass mass, bool moves, uint blocks, float normal_sum, bool after_contacts, Parameters parameters) {
    mass.split = after_contacts ? larger(1.0f, float(blocks) * parameters.inverse_relaxation)
                                : split_factor(mass.split, normal_sum, parameters);
    if (moves) return mass;
    mass.xx = 0.0f;
    mass.xy = 0.0f;
    mass.xz = 0.0f;
    mass.yy = 0.0f;
    mass.yz = 0.0f;
    mass.zz = 0.0f;
    mass.inverse_mass = 0.0f;
    return mass;
}
LAW Velocity changed_by(Velocity velocity, VelocityDelta slot) {
    velocity.linear = velocity.linear + slot.linear;
    velocity.angular = velocity.angular + slot.angular;
    return velocity;
}

// ---- entries of J M^-1 J^T
// M^-1 J^T of one row: what an impulse of 1 along it does to its two bodies.
struct RowResponse {
    vec3 direction;
    uint axis;
    vec3 turn_a;  // I^-1 of the row's angular part, not yet split
    float inverse_mass_a;
    vec3 turn_b;
    float inverse_mass_b;
    float split_a;
    float split_b;
    float pad0;
    float pad1;
};
LAW RowResponse row_response(JointRow row, uint axis, Mass a, Mass b) {
    RowResponse response;
    response.direction = row.direction;
    response.axis = axis;
    response.turn_a = turned_by(a, row.angular_a);
    response.inverse_mass_a = a.inverse_mass;
    response.turn_b = turned_by(b, row.angular_b);
    response.inverse_mass_b = b.inverse_mass;
    response.split_a = a.split;
    response.split_b = b.split;
    response.pad0 = 0.0f;
    response.pad1 = 0.0f;
    return response;
}

// Which bodies two joints share: A or B of the one is A or B of the other. At most two bits are set.
CONSTANT uint ENDS_A_A = 1u;
CONSTANT uint ENDS_A_B = 2u;
CONSTANT uint ENDS_B_A = 4u;
CONSTANT uint ENDS_B_B = 8u;
LAW uint shared_ends(uint a, uint b, uint other_a, uint other_b) {
    uint ends = 0u;
    if (a != NONE && a == other_a) ends = ends | ENDS_A_A;
    if (a != NONE && a == other_b) ends = ends | ENDS_A_B;
    if (b != NONE && b == other_a) ends = ends | ENDS_B_A;
    if (b != NONE && b == other_b) ends = ends | ENDS_B_B;
    return ends;
}

// The part of an entry due to one shared body: the row's speed from an impulse of 1 along the other row.
LAW float entry_through(vec3 direction, vec3 arm, vec3 other_direction, vec3 other_turn, bool both_linear, float inverse_mass,
                        float split) {
    float turning = dot3(arm, other_turn);
    return (both_linear ? dot3(direction, other_direction) * inverse_mass + turning : turning) * split;
}
// The entry of J M^-1 J^T for a row with this direction and these angular parts, and the row of `to`.
LAW float row_entry(vec3 direction, vec3 angular_a, vec3 angular_b, uint axis, RowResponse to, uint ends) {
    bool linear = is_linear(axis) && is_linear(to.axis);
    float sum = 0.0f;
    if ((ends & ENDS_A_A) != 0u)
        sum = entry_through(direction, angular_a, to.direction, to.turn_a, linear, to.inverse_mass_a, to.split_a);
    if ((ends & ENDS_A_B) != 0u) {
        float entry = -entry_through(direction, angular_a, to.direction, to.turn_b, linear, to.inverse_mass_b, to.split_b);
        sum = (ends & ENDS_A_A) != 0u ? sum + entry : entry;
    }
    if ((ends & ENDS_B_A) != 0u) {
        float entry = -entry_through(direction, angular_b, to.direction, to.turn_a, linear, to.inverse_mass_a, to.split_a);
        sum = (ends & (ENDS_A_A | ENDS_A_B)) != 0u ? sum + entry : entry;
    }
    if ((ends & ENDS_B_B) != 0u) {
        float entry = entry_through(direction, angular_b, to.direction, to.turn_b, linear, to.inverse_mass_b, to.split_b);
        sum = ends != ENDS_B_B ? sum + entry : entry;
    }
    return flush_least(sum);
}

// The row at the present poses with its inverse effective mass (`a`, `b`: split bodies; `ends`: ENDS_A_A and ENDS_B_B
// of those that exist).
LAW JointRow placed_row(JointRow row, JointConfiguration at, uint axis, uint flags, VelocityPair v, Mass a, Mass b, uint ends,
                        float h) {
    if (is_linear(axis))
        row = linear_row(row, at, axis, flags, v, h);
    else
        row = angular_row(row, at, axis - 3u, flags, v, h);
    row.coordinate = flush_tiny(row.coordinate);
    row.drift = flush_tiny(row.drift);
    row.inverse_effective_mass =
        row_entry(row.direction, row.angular_a, row.angular_b, axis, row_response(row, axis, a, b), ends);
    row.motor_change = 0.0f;
    row.limit_change = 0.0f;
    return row;
}

// ---- elimination and substitution
LAW float right_hand_side(float speed, RowTarget demand) {
    return -flush_tiny(speed + demand.bias);
}
LAW float softened(float entry, RowTarget demand) {
    return entry + demand.compliance;
}
// The elimination multiplier: entry over pivot.
LAW float multiplier_of(float entry, float inverse_pivot) {
    return entry * inverse_pivot;
}
// The update of an entry or right-hand side in elimination (Schur complement), or of a sum in back substitution.
LAW float less_multiple(float entry, float multiplier, float other) {
    return flush_least(entry - multiplier * other);
}
LAW float substituted(float sum, float inverse_pivot) {
    return flush_tiny(sum * inverse_pivot);
}

// ---- after a solution
struct RowAfter {
    JointRow row;
    uint active_flags;
    uint pad0;
    uint pad1;
    uint pad2;
};
// The row's impulse changes after a solution, within their bounds, and the active set of the next round. `v`: of its
// bodies afterwards.
LAW RowAfter row_after_round(JointAxis axis, JointRow row, uint index, uint active_flags, bool solved, float solution,
                             VelocityPair v, bool biased, bool settling, Parameters parameters) {
    RowAfter after;
    after.row = row_after(row, axis, active_flags, solved, solution, parameters);
    float speed = row_speed(row, is_linear(index), v);
    after.active_flags = active_set_after(axis, row, index, active_flags, solved, solution, speed, biased, settling, parameters);
    after.pad0 = 0u;
    after.pad1 = 0u;
    after.pad2 = 0u;
    return after;
}

LAW float given_change(JointRow row) {
    return row.motor_change + row.limit_change;
}
LAW float row_impulse(JointRow row) {
    return row.motor_impulse + row.limit_impulse;
}
// The impulse applied to whole bodies after a pass: the change, plus the whole impulse where it warm starts a substep.
LAW float handed_impulse(JointRow row, bool warms) {
    float change = given_change(row);
    return warms ? (row_impulse(row) + change) + change : change;
}
// Adds the changes of the pass to the impulses.
LAW JointRow committed(JointRow row) {
    row.motor_impulse = row.motor_impulse + row.motor_change;
    row.limit_impulse = row.limit_impulse + row.limit_change;
    return row;
}
// Clears the impulses: of a broken joint, or after an impact.
LAW JointRow torn(JointRow row) {
    row.motor_impulse = 0.0f;
    row.limit_impulse = 0.0f;
    return row;
}
// The impulse on B along or about the row.
LAW vec3 row_push(JointRow row) {
    return row.direction * row_impulse(row);
}

// Load of a joint: sums of impulses within a step (N s, N m s), then their means over it and the maxima so far (N, N
// m).
struct JointLoad {
    vec3 force;
    float max_force;
    vec3 torque;
    float max_torque;
};
LAW JointLoad mean_load(JointLoad load, Parameters parameters) {
    float inverse_dt = reciprocal(parameters.dt);
    load.force = load.force * inverse_dt;
    load.torque = load.torque * inverse_dt;
    load.max_force = larger(load.max_force, length3(load.force));
    load.max_torque = larger(load.max_torque, length3(load.torque));
    return load;
}
// Whether the mean load of a step exceeds the break force or torque.
LAW bool joint_tears(vec3 force, float break_force, vec3 torque, float break_torque) {
    return length3(force) > break_force || length3(torque) > break_torque;
}

LAWS_END

#endif
