// Direct solver for a block of joints (compute/compile/joint_blocks.h): one sparse system of linear equations.
//
// (J M^-1 J^T + C) dl = -(J v + bias), without the rows at their bounds. The matrix is symmetric positive definite, and
// two joints have an entry in it only if they share a body. It is factored as L D L^T in the order of the block's
// joints, which causes little fill-in (Baraff, Linear-Time Dynamics using Lagrange Multipliers, SIGGRAPH 1996; Davis,
// Direct Methods for Sparse Linear Systems, 2006, ch. 4 and 7). For mass splitting (contact_solver.h) a block counts as
// one constraint however many joints it has, and a chain carries a hundred times its links' weight without stretching.
#ifndef SCREE_PHYSICS_JOINT_BLOCK_H
#define SCREE_PHYSICS_JOINT_BLOCK_H

#include "shaders/physics/joint/joint_matrix.h"
#include "shaders/physics/joint/joint_pass.h"

LAWS_BEGIN

CONSTANT uint JOINT_ROUNDS = 8u;    // solutions of a block in a pass at most
CONSTANT uint SETTLING_ROUND = 2u;  // then bounds are only released: else some blocks cycle

// Which bodies two joints share, as ENDS_*.
LAW int shared_ends(uint a, uint b, uint other_a, uint other_b) {
    int ends = 0;
    if (a != NONE && a == other_a) ends = ends | ENDS_A_A;
    if (a != NONE && a == other_b) ends = ends | ENDS_A_B;
    if (b != NONE && b == other_a) ends = ends | ENDS_B_A;
    if (b != NONE && b == other_b) ends = ends | ENDS_B_B;
    return ends;
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
