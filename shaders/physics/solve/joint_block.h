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
#include "shaders/physics/solve/joint_matrix.h"
#include "shaders/physics/solve/mass_splitting.h"

LAWS_BEGIN

CONSTANT uint JOINT_ROUNDS = 8u;    // solutions of a block in a pass at most
CONSTANT uint SETTLING_ROUND = 2u;  // then bounds are only released: else some blocks cycle

// ---- split bodies
// The split mass of a body of the block. In the biased pass, and in the relax pass of a block that is struck, joints are
// solved after the contacts, and only blocks share the body; else contacts share it as well.
LAW Mass mass_of_member(BodyMass body, bool moves, uint blocks, float normal_sum, bool after_contacts, Parameters parameters) {
    Mass mass = whole_mass(body);
    mass.split = after_contacts ? larger(1.0f, float(blocks) * parameters.inverse_relaxation)
                                : split_factor(body.split_state, normal_sum, parameters);
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

// Which bodies two joints share, as ENDS_*.
LAW int shared_ends(uint a, uint b, uint other_a, uint other_b) {
    int ends = 0;
    if (a != NONE && a == other_a) ends = ends | ENDS_A_A;
    if (a != NONE && a == other_b) ends = ends | ENDS_A_B;
    if (b != NONE && b == other_a) ends = ends | ENDS_B_A;
    if (b != NONE && b == other_b) ends = ends | ENDS_B_B;
    return ends;
}

// ---- after a solution
struct RowAfter {
    JointRow row;
    uint active_flags;
    float rotor_change;
    uint pad0;
    uint pad1;
};
// The impulse changes of a row and its rotor after a solution, within their bounds, and the active set of the next round.
// `solution`: of the row and its rotor together; what the row's bounds cut off is the rotor's. `speed`: of the row afterwards.
LAW RowAfter row_after_round(JointAxis axis, JointRow row, JointRotor rotor, uint index, uint active_flags, bool solved,
                             float solution, float speed, bool biased, bool settling, Parameters parameters) {
    RowAfter after;
    after.rotor_change = 0.0f;
    if (has_rotor(axis) && solved) {
        after.rotor_change = solution;
        solved = axis_is_solved(axis, row, active_flags, biased, parameters);
        solution = solved ? flush_tiny((solution - given_change(row)) - rotor_impulse(rotor, speed)) : 0.0f;
    }
    after.row = row_after(row, axis, active_flags, solved, solution, parameters);
    after.active_flags = active_set_after(axis, row, index, active_flags, solved, solution, speed, biased, settling, parameters);
    after.pad0 = 0u;
    after.pad1 = 0u;
    return after;
}

LAW float row_impulse(JointRow row, JointRotor rotor) {
    return rotor.inertia > 0.0f ? rotor.impulse : row.motor_impulse + row.limit_impulse;
}
// The impulse applied to whole bodies after a pass: the change, plus the whole impulse where it warm starts a substep.
LAW float handed_impulse(JointRow row, JointRotor rotor, bool warms) {
    float change = rotor.inertia > 0.0f ? rotor.change : given_change(row);
    return warms ? (row_impulse(row, rotor) + change) + change : change;
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
LAW JointRotor torn_rotor(JointRotor rotor) {
    rotor.impulse = 0.0f;
    return rotor;
}
// The impulse on B along or about the row.
LAW vec3 row_push(JointRow row, JointRotor rotor) {
    return row.direction * row_impulse(row, rotor);
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
