// A pass over a block of joints: the split masses of its bodies, and what a solution does to rows and rotors. In SIMD a lane
// is a block.
#ifndef SCREE_PHYSICS_JOINT_PASS_H
#define SCREE_PHYSICS_JOINT_PASS_H

#include "shaders/physics/body/mass_splitting.h"
#include "shaders/physics/joint/joint_axis.h"

LAWS_BEGIN

// The split mass of a body of the block. In the biased pass, and in the relax pass of a block that is struck, joints are
// solved after the contacts, and only blocks share the body; else contacts share it as well.
LAW Mass mass_of_member(BodyMass body, bool moves, uint blocks, float normal_sum, bool after_contacts, Parameters parameters) {
    Mass mass = whole_mass(body);
    float among_blocks = larger(1.0f, float(blocks) * parameters.inverse_relaxation);
    mass.split = choose(after_contacts, among_blocks, split_factor(body.shares, normal_sum, parameters));
    mass.xx = choose(moves, mass.xx, 0.0f);
    mass.xy = choose(moves, mass.xy, 0.0f);
    mass.xz = choose(moves, mass.xz, 0.0f);
    mass.yy = choose(moves, mass.yy, 0.0f);
    mass.yz = choose(moves, mass.yz, 0.0f);
    mass.zz = choose(moves, mass.zz, 0.0f);
    mass.inverse_mass = choose(moves, mass.inverse_mass, 0.0f);
    return mass;
}
LAW Velocity changed_by(Velocity velocity, VelocityDelta slot) {
    velocity.linear = velocity.linear + slot.linear;
    velocity.angular = velocity.angular + slot.angular;
    return velocity;
}

struct RowAfter {
    JointRow row;
    uint active_flags;
    float rotor_change;
};
// The impulse changes of a row and its rotor after a solution, within their bounds, and the active set of the next round.
// `solution`: of the row and its rotor together; what the row's bounds cut off is the rotor's. `speed`: of the row afterwards.
LAW RowAfter row_after_round(JointAxis axis, JointRow row, JointRotor rotor, uint index, uint active_flags, bool solved,
                             float solution, float speed, bool biased, bool settling, Parameters parameters) {
    RowAfter after;
    after.rotor_change = 0.0f;
    bool turns = has_rotor(axis) && solved;
    if (!none(turns)) {
        bool with_axis = axis_is_solved(axis, row, active_flags, biased, parameters);
        after.rotor_change = choose(turns, solution, 0.0f);
        float of_row = flush_tiny((solution - given_change(row)) - rotor_impulse(rotor, speed));
        solution = choose(turns, choose(with_axis, of_row, 0.0f), solution);
        solved = solved && (with_axis || !turns);
    }
    after.row = row_after(row, axis, active_flags, solved, solution, parameters);
    after.active_flags = active_set_after(axis, row, index, active_flags, solved, solution, speed, biased, settling, parameters);
    return after;
}

LAW float row_impulse(JointRow row, JointRotor rotor) {
    return choose(rotor.inertia > 0.0f, rotor.impulse, row.motor_impulse + row.limit_impulse);
}
// The impulse applied to whole bodies after a pass: the change, plus the whole impulse where it warm starts a substep.
LAW float handed_impulse(JointRow row, JointRotor rotor, bool warms) {
    float change = choose(rotor.inertia > 0.0f, rotor.change, given_change(row));
    return choose(warms, (row_impulse(row, rotor) + change) + change, change);
}
// Adds the changes of the pass to the impulses.
LAW JointRow committed(JointRow row) {
    row.motor_impulse = bounded_impulse(row.motor_impulse + row.motor_change, row);
    row.limit_impulse = bounded_impulse(row.limit_impulse + row.limit_change, row);
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

LAWS_END

#endif
