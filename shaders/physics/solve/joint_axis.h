// What an axis of a joint asks of its row, a lock, motor, spring or limit, and which of its bounds act (the active set).
//
// A row's impulse is that of its drive plus that of its limit. Soft rows: implicit springs and a compliance of the rigid ones, J
// v
// + bias + compliance * change = 0 (Catto, Soft Constraints, GDC 2011). Limits are complementarity conditions and motors box
// constraints; rows that turn out to be at a bound, or to leave one, are exchanged and the block is solved again (block principal
// pivoting: Cottle, Pang, Stone, The Linear Complementarity Problem, 1992, ch. 4).
#ifndef SCREE_PHYSICS_JOINT_AXIS_H
#define SCREE_PHYSICS_JOINT_AXIS_H

#include "shaders/physics/solve/joint.h"

LAWS_BEGIN

// Part of a gap that a substep closes. With 1, a joint that contacts hold open shakes what it holds.
CONSTANT float JOINT_RATE = 0.25f;
CONSTANT float JOINT_TURN_SPEED = 6.0f;  // rad/s, greatest speed at which axes are turned together
// Compliance of rigid rows, of what the lent bodies give themselves: mechanisms have more joints than they need, and without any
// the surplus has no solution. More, and chains stretch; less, and what is surplus grows in the rounding of a float.
CONSTANT float JOINT_COMPLIANCE = 1.0e-3f;
CONSTANT float GENTLE_SPRING = 0.25f;  // of what would throw a body past its place in one substep: weaker ones are forces

struct RowTarget {  // row speed + bias + compliance * impulse's change = 0
    float bias;
    float compliance;
};

LAW float joint_push(float coordinate, uint axis, Parameters parameters) {
    float fastest = is_linear(axis) ? parameters.push_speed : JOINT_TURN_SPEED;
    return clamped(coordinate * (JOINT_RATE * parameters.inverse_h), -fastest, fastest);
}

// A spring so weak that it may act as the force that it is at the substep's start, which takes no energy out of its swinging.
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

// Whether the drive is an unknown of the block's equations; if not, its impulse is saturated_motor_impulse().
LAW bool motor_is_solved(JointAxis axis, JointRow row, uint active_flags, bool biased, Parameters parameters) {
    if ((active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u) return false;
    if ((axis.mode & AXIS_LOCKED) != 0u) return true;
    if ((active_flags & (MOTOR_AT_MIN | MOTOR_AT_MAX)) != 0u) return false;
    if ((axis.mode & AXIS_SPRING) != 0u) return biased && !is_gentle(axis, row.inverse_effective_mass, parameters);
    return (axis.mode & AXIS_MOTOR) != 0u;
}
// `speed`: of the row as the pass begins.
LAW float saturated_motor_impulse(JointAxis axis, JointRow row, uint active_flags, float speed, bool biased,
                                  Parameters parameters) {
    float most = most_impulse(axis, parameters);
    bool stopped = (active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u;
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
LAW RowTarget motor_target(JointAxis axis, JointRow row, uint index, bool biased, Parameters parameters) {
    RowTarget demand;
    demand.compliance = JOINT_COMPLIANCE * row.inverse_effective_mass;
    if ((axis.mode & AXIS_LOCKED) != 0u) {
        demand.bias = 0.0f;
        if (biased)
            demand.bias =
                (joint_push(row.coordinate - axis.rest, index, parameters) + row.drift) + demand.compliance * row.motor_impulse;
    } else if ((axis.mode & AXIS_SPRING) != 0u) {
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
LAW float limit_bias(float room, float drift, uint index, bool biased, Parameters parameters) {
    if (room > 0.0f) return room * parameters.inverse_h + (biased ? drift : 0.0f);
    return biased ? joint_push(room, index, parameters) + drift : 0.0f;
}
// Of the lower limit if `low`, else of the upper, whose speed and impulse are negative.
LAW RowTarget limit_target(JointAxis axis, JointRow row, uint index, bool low, bool biased, Parameters parameters) {
    RowTarget demand;
    demand.compliance = JOINT_COMPLIANCE * row.inverse_effective_mass;
    demand.bias = low ? limit_bias(row.coordinate - axis.lower, row.drift, index, biased, parameters)
                      : -limit_bias(axis.upper - row.coordinate, -row.drift, index, biased, parameters);
    if (biased) demand.bias = demand.bias + demand.compliance * row.limit_impulse;
    return demand;
}

// The bits of an axis after a solution: which bounds act. `speed`: of the row afterwards; `solution`: of the row, if it was
// solved.
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
    float most = most_impulse(axis, parameters);
    if (solved) {
        if (row.motor_impulse + solution < -most) return MOTOR_AT_MIN;
        if (row.motor_impulse + solution > most) return MOTOR_AT_MAX;
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

// Impulses within their bounds, whatever the last solution said.
LAW JointRow row_after(JointRow row, JointAxis axis, uint active_flags, bool solved, float solution, Parameters parameters) {
    bool stopped = (active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u;
    if (solved && stopped) {
        float after = row.limit_impulse + solution;
        after = (active_flags & LIMIT_LOWER) != 0u ? positive(after) : -positive(-after);
        row.limit_change = after - row.limit_impulse;
    } else if (solved) {
        float after = row.motor_impulse + solution;
        if ((axis.mode & AXIS_LOCKED) == 0u)
            after = clamped(after, -most_impulse(axis, parameters), most_impulse(axis, parameters));
        row.motor_change = after - row.motor_impulse;
    }
    return row;
}

// Whether the axis asks anything of bodies that can move.
LAW bool row_acts(JointAxis axis, JointRow row) {
    return axis.mode != 0u && row.inverse_effective_mass > 0.0f;
}
LAW bool is_stopped(uint active_flags) {
    return (active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u;
}
// Whether the row is an unknown of the block's equations.
LAW bool row_is_unknown(JointAxis axis, JointRow row, uint active_flags, bool biased, Parameters parameters) {
    return is_stopped(active_flags) || motor_is_solved(axis, row, active_flags, biased, parameters);
}
// The row with the changes of those of its impulses that are given, not solved for. `speed`: of the row as the pass begins.
LAW JointRow row_given(JointAxis axis, JointRow row, uint active_flags, float speed, bool biased, Parameters parameters) {
    row.limit_change = is_stopped(active_flags) ? 0.0f : -row.limit_impulse;
    row.motor_change = 0.0f;
    if (!motor_is_solved(axis, row, active_flags, biased, parameters))
        row.motor_change = saturated_motor_impulse(axis, row, active_flags, speed, biased, parameters) - row.motor_impulse;
    return row;
}
LAW RowTarget row_demand(JointAxis axis, JointRow row, uint index, uint active_flags, bool biased, Parameters parameters) {
    if (is_stopped(active_flags)) return limit_target(axis, row, index, (active_flags & LIMIT_LOWER) != 0u, biased, parameters);
    return motor_target(axis, row, index, biased, parameters);
}

LAWS_END

#endif
