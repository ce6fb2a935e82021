// Joint axes: locks, motors, springs and limits as targets of a Jacobian row, and the active set of their bounds.
//
// The impulse of a row is that of its motor (or lock or spring) plus that of its limit. Springs are implicit and rigid
// rows have a compliance: J v + bias + compliance * change = 0 (Catto, Soft Constraints, GDC 2011). A rotor (armature)
// is a body of one degree of freedom whose speed is the axis's: such a row too, of compliance 1 / inertia. Motors and limits
// of its axis act on the rotor, and their impulses and its own are known by their sum, which moves the bodies: of a light link
// it is a small difference of large impulses. Limits are
// complementarity conditions and motors box constraints; rows found to be at a bound, or to leave one, change their
// state and the block is solved again (block principal pivoting: Cottle, Pang, Stone, The Linear Complementarity
// Problem, 1992, ch. 4).
#ifndef SCREE_PHYSICS_JOINT_AXIS_H
#define SCREE_PHYSICS_JOINT_AXIS_H

#include "shaders/physics/solve/joint.h"

LAWS_BEGIN

// Baumgarte factor: the part of the position error corrected per substep. With 1, a joint held open by contacts shakes.
CONSTANT float JOINT_RATE = 0.25f;
CONSTANT float JOINT_TURN_SPEED = 6.0f;  // rad/s, greatest angular correction
// Compliance of rigid rows, relative to their inverse effective mass: mechanisms have redundant joints, and without
// compliance their equations are singular. More stretches chains; less lets the redundant part grow from rounding.
CONSTANT float JOINT_COMPLIANCE = 1.0e-3f;
CONSTANT float GENTLE_SPRING = 0.25f;  // stability limit of explicit springs: softer ones act as forces

struct RowTarget {  // row speed + bias + compliance * impulse's change = 0
    float bias;
    float compliance;
};

// Bias velocity that corrects a position error (Baumgarte), limited, m/s or rad/s.
LAW float joint_push(float coordinate, uint axis, Parameters parameters) {
    float fastest = is_linear(axis) ? parameters.push_speed : JOINT_TURN_SPEED;
    return clamped(coordinate * (JOINT_RATE * parameters.inverse_h), -fastest, fastest);
}

// Whether a spring is soft enough to act explicitly, as its force at the start of the substep, which takes no energy
// out of its oscillation.
LAW bool is_gentle(JointAxis axis, float inverse_effective_mass, Parameters parameters) {
    float h = parameters.h;
    return h * h * axis.stiffness * inverse_effective_mass < GENTLE_SPRING &&
           h * axis.damping * inverse_effective_mass < GENTLE_SPRING;
}

LAW float most_impulse(JointAxis axis, Parameters parameters) {
    return axis.most * parameters.h;
}
LAW float spring_impulse(JointAxis axis, float coordinate, float speed, Parameters parameters) {
    float force = axis.stiffness * (axis.rest - coordinate) + axis.damping * (axis.speed - speed);
    return clamped(force * parameters.h, -most_impulse(axis, parameters), most_impulse(axis, parameters));
}

// A spring beside a motor, or beside dry friction, a motor of speed 0: the motor's bounds are about the impulse of the spring,
// so what sticks bears both, and what slides the spring and the whole friction. Springs that are too stiff to act
// explicitly are taken implicitly, as if the row were alone.
LAW bool has_spring_and_motor(JointAxis axis) {
    return (axis.mode & AXIS_SPRING) != 0u && (axis.mode & AXIS_MOTOR) != 0u;
}
LAW float share_of_spring(JointAxis axis, JointRow row, float speed, Parameters parameters) {
    if (!has_spring_and_motor(axis)) return 0.0f;
    float h = parameters.h;
    if (is_gentle(axis, row.inverse_effective_mass, parameters))
        return (axis.stiffness * (axis.rest - row.coordinate) - axis.damping * speed) * h;
    float resisting = axis.damping + h * axis.stiffness;
    return (axis.stiffness * (axis.rest - row.coordinate) - resisting * speed) *
           (h * reciprocal(1.0f + h * resisting * row.inverse_effective_mass));
}

// Bounds of the impulse of a motor or spring that moves as it should.
LAW float least_of_motor(JointAxis axis, JointRow row, Parameters parameters) {
    float most = most_impulse(axis, parameters);
    return has_spring_and_motor(axis) ? share_of_spring(axis, row, axis.speed, parameters) - most : -most;
}
LAW float most_of_motor(JointAxis axis, JointRow row, Parameters parameters) {
    float most = most_impulse(axis, parameters);
    return has_spring_and_motor(axis) ? share_of_spring(axis, row, axis.speed, parameters) + most : most;
}

// Whether the motor impulse is an unknown of the block's equations; if not, saturated_motor_impulse() gives it.
LAW bool motor_is_solved(JointAxis axis, JointRow row, uint active_flags, bool biased, Parameters parameters) {
    if ((active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u) return false;
    if ((axis.mode & AXIS_LOCKED) != 0u) return true;
    if ((active_flags & (MOTOR_AT_MIN | MOTOR_AT_MAX)) != 0u) return false;
    if (has_spring_and_motor(axis)) return true;
    if ((axis.mode & AXIS_SPRING) != 0u) return biased && !is_gentle(axis, row.inverse_effective_mass, parameters);
    return (axis.mode & AXIS_MOTOR) != 0u;
}
// The motor impulse of a row that does not solve for it. `speed`: of the row as the pass begins.
LAW float saturated_motor_impulse(JointAxis axis, JointRow row, uint active_flags, float speed, bool biased,
                                  Parameters parameters) {
    float most = most_impulse(axis, parameters);
    bool stopped = (active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u;
    if (has_spring_and_motor(axis)) {
        if (!biased) return row.motor_impulse;
        float share = share_of_spring(axis, row, stopped ? 0.0f : speed, parameters);
        if (stopped && axis.speed == 0.0f) return clamped(row.motor_impulse, share - most, share + most);
        bool pushes_back = stopped ? axis.speed < 0.0f : (active_flags & MOTOR_AT_MIN) != 0u;
        return pushes_back ? share - most : share + most;
    }
    if ((axis.mode & AXIS_SPRING) != 0u) {
        if (!biased) return row.motor_impulse;
        if (stopped || is_gentle(axis, row.inverse_effective_mass, parameters))
            return spring_impulse(axis, row.coordinate, stopped ? 0.0f : speed, parameters);
    }
    if ((axis.mode & AXIS_MOTOR) != 0u && stopped)
        return axis.speed > 0.0f ? most : (axis.speed < 0.0f ? -most : clamped(row.motor_impulse, -most, most));
    if ((active_flags & MOTOR_AT_MIN) != 0u) return -most;
    if ((active_flags & MOTOR_AT_MAX) != 0u) return most;
    return 0.0f;
}
// The equation of a lock, spring or motor.
LAW RowTarget motor_target(JointAxis axis, JointRow row, uint index, bool biased, Parameters parameters) {
    RowTarget demand;
    demand.compliance = JOINT_COMPLIANCE * row.inverse_effective_mass;
    if ((axis.mode & AXIS_LOCKED) != 0u) {
        demand.bias = 0.0f;
        if (biased)
            demand.bias =
                (joint_push(row.coordinate - axis.rest, index, parameters) + row.drift) + demand.compliance * row.motor_impulse;
    } else if ((axis.mode & AXIS_SPRING) != 0u && (axis.mode & AXIS_MOTOR) == 0u) {
        float resisting = axis.damping + parameters.h * axis.stiffness;
        float yielding = reciprocal(resisting);
        demand.compliance = yielding * parameters.inverse_h;
        demand.bias = (axis.stiffness * (row.coordinate - axis.rest) - axis.damping * axis.speed) * yielding +
                      demand.compliance * row.motor_impulse;
    } else {
        demand.bias = -axis.speed;
    }
    return demand;
}
// Bias of a limit: speculative while there is room, else the correction of the violation in the biased pass.
LAW float limit_bias(float room, float drift, uint index, bool biased, Parameters parameters) {
    if (room > 0.0f) return room * parameters.inverse_h + (biased ? drift : 0.0f);
    return biased ? joint_push(room, index, parameters) + drift : 0.0f;
}
// The equation of the lower limit if `low`, else of the upper, whose speed and impulse are negative.
LAW RowTarget limit_target(JointAxis axis, JointRow row, uint index, bool low, bool biased, Parameters parameters) {
    RowTarget demand;
    demand.compliance = JOINT_COMPLIANCE * row.inverse_effective_mass;
    demand.bias = low ? limit_bias(row.coordinate - axis.lower, row.drift, index, biased, parameters)
                      : -limit_bias(axis.upper - row.coordinate, -row.drift, index, biased, parameters);
    if (biased) demand.bias = demand.bias + demand.compliance * row.limit_impulse;
    return demand;
}

// The active set of an axis after a solution. `speed`: of the row afterwards; `solution`: of the row, if it was an
// unknown.
LAW uint active_set_after(JointAxis axis, JointRow row, uint index, uint active_flags, bool solved, float solution, float speed,
                          bool biased, bool settling, Parameters parameters) {
    if ((active_flags & LIMIT_LOWER) != 0u) {
        if (row.limit_impulse + solution < 0.0f) return active_flags & ~LIMIT_LOWER;
        return active_flags;
    }
    if ((active_flags & LIMIT_UPPER) != 0u) {
        if (row.limit_impulse + solution > 0.0f) return active_flags & ~LIMIT_UPPER;
        return active_flags;
    }
    if ((axis.mode & AXIS_LIMITED) != 0u && !settling) {
        RowTarget low = limit_target(axis, row, index, true, biased, parameters);
        if (speed + low.bias < 0.0f) return LIMIT_LOWER;
        RowTarget high = limit_target(axis, row, index, false, biased, parameters);
        if (speed + high.bias > 0.0f) return LIMIT_UPPER;
    }
    if ((axis.mode & AXIS_LOCKED) != 0u || (axis.mode & (AXIS_MOTOR | AXIS_SPRING)) == 0u) return active_flags;
    if (solved) {
        if (row.motor_impulse + solution < least_of_motor(axis, row, parameters)) return MOTOR_AT_MIN;
        if (row.motor_impulse + solution > most_of_motor(axis, row, parameters)) return MOTOR_AT_MAX;
        return 0u;
    }
    if (active_flags != 0u && !settling) {
        float error = speed + motor_target(axis, row, index, biased, parameters).bias;
        if ((axis.mode & AXIS_SPRING) != 0u && !biased) return active_flags;
        if ((active_flags & MOTOR_AT_MIN) != 0u && error < 0.0f) return 0u;
        if ((active_flags & MOTOR_AT_MAX) != 0u && error > 0.0f) return 0u;
    }
    return active_flags;
}
LAW uint active_set_of(uint active_set, uint axis) {
    return (active_set >> (4u * axis)) & 15u;
}
LAW uint with_active_set(uint active_set, uint axis, uint active_flags) {
    return (active_set & ~(15u << (4u * axis))) | (active_flags << (4u * axis));
}

// Changes of the row's impulses, clamped to their bounds.
LAW JointRow row_after(JointRow row, JointAxis axis, uint active_flags, bool solved, float solution, Parameters parameters) {
    bool stopped = (active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u;
    if (solved && stopped) {
        float after = flush_tiny(row.limit_impulse + solution);
        after = (active_flags & LIMIT_LOWER) != 0u ? positive(after) : -positive(-after);
        row.limit_change = after - row.limit_impulse;
    } else if (solved) {
        float after = flush_tiny(row.motor_impulse + solution);
        if ((axis.mode & AXIS_LOCKED) == 0u)
            after = clamped(after, least_of_motor(axis, row, parameters), most_of_motor(axis, row, parameters));
        row.motor_change = after - row.motor_impulse;
    }
    return row;
}

// Whether the axis constrains a body that can move.
LAW bool row_acts(JointAxis axis, JointRow row) {
    return axis.mode != 0u && row.inverse_effective_mass > 0.0f;
}
LAW bool is_stopped(uint active_flags) {
    return (active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u;
}
LAW bool has_rotor(JointAxis axis) {
    return (axis.mode & AXIS_ROTOR) != 0u;
}
// Whether the lock, motor, spring or limit of the row is an unknown.
LAW bool axis_is_solved(JointAxis axis, JointRow row, uint active_flags, bool biased, Parameters parameters) {
    return is_stopped(active_flags) || motor_is_solved(axis, row, active_flags, biased, parameters);
}
// Whether the row is an unknown of the block's equations: a rotor always answers to the axis's speed.
LAW bool row_is_unknown(JointAxis axis, JointRow row, uint active_flags, bool biased, Parameters parameters) {
    return has_rotor(axis) || axis_is_solved(axis, row, active_flags, biased, parameters);
}
// The row with the changes of those impulses that are given, not unknowns. `speed`: of the row as the pass begins.
LAW JointRow row_given(JointAxis axis, JointRow row, uint active_flags, float speed, bool biased, Parameters parameters) {
    row.limit_change = is_stopped(active_flags) ? 0.0f : -row.limit_impulse;
    row.motor_change = 0.0f;
    if (!motor_is_solved(axis, row, active_flags, biased, parameters))
        row.motor_change =
            flush_tiny(saturated_motor_impulse(axis, row, active_flags, speed, biased, parameters)) - row.motor_impulse;
    return row;
}
LAW float given_change(JointRow row) {
    return row.motor_change + row.limit_change;
}
// What is given pushes the bodies before the equations are solved, but a rotor takes it.
LAW float given_push(JointAxis axis, JointRow row) {
    return has_rotor(axis) ? 0.0f : given_change(row);
}
// The equation of the sum of a row's impulses, of which `given` are no unknowns, and its rotor's: both meet the axis's speed,
// like springs side by side.
LAW RowTarget with_rotor(RowTarget demand, JointRotor rotor, float given) {
    float share = reciprocal(1.0f + demand.compliance * rotor.inertia);
    demand.bias = (demand.bias - (rotor.speed * rotor.inertia + given) * demand.compliance) * share;
    demand.compliance = demand.compliance * share;
    return demand;
}
// `row`: with the changes that are given.
LAW RowTarget row_demand(JointAxis axis, JointRow row, JointRotor rotor, uint index, uint active_flags, bool biased,
                         Parameters parameters) {
    RowTarget demand;
    if (has_rotor(axis) && !axis_is_solved(axis, row, active_flags, biased, parameters)) {
        demand.compliance = reciprocal(rotor.inertia);
        demand.bias = -(rotor.speed + given_change(row) * demand.compliance);
        return demand;
    }
    if (is_stopped(active_flags))
        demand = limit_target(axis, row, index, (active_flags & LIMIT_LOWER) != 0u, biased, parameters);
    else
        demand = motor_target(axis, row, index, biased, parameters);
    if (has_rotor(axis)) return with_rotor(demand, rotor, given_change(row));
    return demand;
}
// The rotor's impulse on the axis in a pass, if its speed becomes the axis's, which is `speed` afterwards.
LAW float rotor_impulse(JointRotor rotor, float speed) {
    return rotor.inertia * (rotor.speed - speed);
}
// The rotor's part of the impulse of a substep.
LAW float impulse_of_rotor(JointRow row, JointRotor rotor) {
    return rotor.impulse - (row.motor_impulse + row.limit_impulse);
}
// A rotor keeps its own speed from step to step: contacts change that of the axis after the joints' last pass, and a rotor that
// took it over gained energy (a paddle of 100 times the inertia by its rotor that struck a box, 87%). It takes the speed of
// its axis where velocities were set (sleep.h), and has none where both bodies were `at_rest`: an impulse that wakes them turns
// the rotor, too.
LAW JointRotor rotor_as_step_begins(JointRotor rotor, bool were_set, bool at_rest, float axis_speed) {
    if (were_set)
        rotor.speed = axis_speed;
    else if (at_rest)
        rotor.speed = 0.0f;
    return rotor;
}
// The rotor after its impulse on the axis.
LAW JointRotor rotor_slowed(JointRotor rotor, float impulse) {
    rotor.speed = flush_tiny(rotor.speed - impulse * reciprocal(rotor.inertia));
    return rotor;
}
// Adds the change of the pass to the impulse, which warm starts the next substep if it `warms`. `row`: with its changes added.
LAW JointRotor rotor_after_pass(JointRotor rotor, JointRow row, bool warms) {
    rotor = rotor_slowed(rotor, rotor.change - given_change(row));
    rotor.impulse = flush_tiny(rotor.impulse + rotor.change);
    rotor.change = 0.0f;
    if (warms) rotor = rotor_slowed(rotor, impulse_of_rotor(row, rotor));
    return rotor;
}
// The rotor when the impulse of its motor is taken back.
LAW JointRotor rotor_without_motor(JointRotor rotor, JointRow row) {
    if (rotor.inertia > 0.0f) rotor.impulse = flush_tiny(rotor.impulse - row.motor_impulse);
    return rotor;
}

LAWS_END

#endif
