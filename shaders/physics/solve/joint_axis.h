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

struct Demand {  // row speed + bias + compliance * impulse's change = 0
    float bias;
    float compliance;
};

LAW float joint_push(float place, uint axis, Parameters parameters) {
    float fastest = is_linear(axis) ? parameters.push_speed : JOINT_TURN_SPEED;
    return clamped(place * (JOINT_RATE * parameters.inverse_h), -fastest, fastest);
}

// A spring so weak that it may act as the force that it is at the substep's start, which takes no energy out of its swinging.
LAW bool is_gentle(JointAxis axis, float give, Parameters parameters) {
    float h = parameters.h;
    return h * h * axis.stiffness * give < GENTLE_SPRING && h * axis.damping * give < GENTLE_SPRING;
}

LAW float most_impulse(JointAxis axis, Parameters parameters) {
    return axis.most * parameters.h;
}
LAW float spring_impulse(JointAxis axis, float place, float speed, Parameters parameters) {
    float force = axis.stiffness * (axis.rest - place) + axis.damping * (axis.speed - speed);
    return clamped(force * parameters.h, -most_impulse(axis, parameters), most_impulse(axis, parameters));
}

// Whether the drive is an unknown of the block's equations; if not, its impulse is held_drive().
LAW bool drive_is_solved(JointAxis axis, JointRow row, uint pin, bool biased, Parameters parameters) {
    if ((pin & (STOP_LOW | STOP_HIGH)) != 0u) return false;
    if ((axis.mode & AXIS_LOCKED) != 0u) return true;
    if ((pin & (PIN_LOW | PIN_HIGH)) != 0u) return false;
    if ((axis.mode & AXIS_SPRING) != 0u) return biased && !is_gentle(axis, row.give, parameters);
    return (axis.mode & AXIS_MOTOR) != 0u;
}
// `speed`: of the row as the pass begins.
LAW float held_drive(JointAxis axis, JointRow row, uint pin, float speed, bool biased, Parameters parameters) {
    float most = most_impulse(axis, parameters);
    bool stopped = (pin & (STOP_LOW | STOP_HIGH)) != 0u;
    if ((axis.mode & AXIS_SPRING) != 0u) {
        if (!biased) return row.drive;
        if (stopped || is_gentle(axis, row.give, parameters))
            return spring_impulse(axis, row.place, stopped ? 0.0f : speed, parameters);
    }
    if ((axis.mode & AXIS_MOTOR) != 0u && stopped)
        return axis.speed > 0.0f ? most : (axis.speed < 0.0f ? -most : clamped(row.drive, -most, most));
    if ((pin & PIN_LOW) != 0u) return -most;
    if ((pin & PIN_HIGH) != 0u) return most;
    return 0.0f;
}
LAW Demand drive_demand(JointAxis axis, JointRow row, uint index, bool biased, Parameters parameters) {
    Demand demand;
    demand.compliance = JOINT_COMPLIANCE * row.give;
    if ((axis.mode & AXIS_LOCKED) != 0u) {
        demand.bias = 0.0f;
        if (biased)
            demand.bias = (joint_push(row.place - axis.rest, index, parameters) + row.drift) + demand.compliance * row.drive;
    } else if ((axis.mode & AXIS_SPRING) != 0u) {
        float resisting = axis.damping + parameters.h * axis.stiffness;
        float yielding = reciprocal(resisting);
        demand.compliance = yielding * parameters.inverse_h;
        demand.bias =
            (axis.stiffness * (row.place - axis.rest) - axis.damping * axis.speed) * yielding + demand.compliance * row.drive;
    } else {
        demand.bias = -axis.speed;
    }
    return demand;
}
LAW float stop_bias_for(float room, float drift, uint index, bool biased, Parameters parameters) {
    if (room > 0.0f) return room * parameters.inverse_h + (biased ? drift : 0.0f);
    return biased ? joint_push(room, index, parameters) + drift : 0.0f;
}
// Of the lower limit if `low`, else of the upper, whose speed and impulse are negative.
LAW Demand stop_demand(JointAxis axis, JointRow row, uint index, bool low, bool biased, Parameters parameters) {
    Demand demand;
    demand.compliance = JOINT_COMPLIANCE * row.give;
    demand.bias = low ? stop_bias_for(row.place - axis.lower, row.drift, index, biased, parameters)
                      : -stop_bias_for(axis.upper - row.place, -row.drift, index, biased, parameters);
    if (biased) demand.bias = demand.bias + demand.compliance * row.stop;
    return demand;
}

// The bits of an axis after a solution: which bounds act. `speed`: of the row afterwards; `solution`: of the row, if it was
// solved.
LAW uint pins_after(JointAxis axis, JointRow row, uint index, uint pin, bool solved, float solution, float speed, bool biased,
                    bool settling, Parameters parameters) {
    if ((pin & STOP_LOW) != 0u) {
        if (row.stop + solution < 0.0f) return pin & ~STOP_LOW;
        return pin;
    }
    if ((pin & STOP_HIGH) != 0u) {
        if (row.stop + solution > 0.0f) return pin & ~STOP_HIGH;
        return pin;
    }
    if ((axis.mode & AXIS_LIMITED) != 0u && !settling) {
        Demand low = stop_demand(axis, row, index, true, biased, parameters);
        if (speed + low.bias < 0.0f) return STOP_LOW;
        Demand high = stop_demand(axis, row, index, false, biased, parameters);
        if (speed + high.bias > 0.0f) return STOP_HIGH;
    }
    if ((axis.mode & AXIS_LOCKED) != 0u || (axis.mode & (AXIS_MOTOR | AXIS_SPRING)) == 0u) return pin;
    float most = most_impulse(axis, parameters);
    if (solved) {
        if (row.drive + solution < -most) return PIN_LOW;
        if (row.drive + solution > most) return PIN_HIGH;
        return 0u;
    }
    if (pin != 0u && !settling) {
        float error = speed + drive_demand(axis, row, index, biased, parameters).bias;
        if ((axis.mode & AXIS_SPRING) != 0u && !biased) return pin;
        if ((pin & PIN_LOW) != 0u && error < 0.0f) return 0u;
        if ((pin & PIN_HIGH) != 0u && error > 0.0f) return 0u;
    }
    return pin;
}
LAW uint pins_of(uint pins, uint axis) {
    return (pins >> (4u * axis)) & 15u;
}
LAW uint with_pins(uint pins, uint axis, uint pin) {
    return (pins & ~(15u << (4u * axis))) | (pin << (4u * axis));
}

// Impulses within their bounds, whatever the last solution said.
LAW JointRow row_after(JointRow row, JointAxis axis, uint pin, bool solved, float solution, Parameters parameters) {
    bool stopped = (pin & (STOP_LOW | STOP_HIGH)) != 0u;
    if (solved && stopped) {
        float after = row.stop + solution;
        after = (pin & STOP_LOW) != 0u ? positive(after) : -positive(-after);
        row.stop_change = after - row.stop;
    } else if (solved) {
        float after = row.drive + solution;
        if ((axis.mode & AXIS_LOCKED) == 0u)
            after = clamped(after, -most_impulse(axis, parameters), most_impulse(axis, parameters));
        row.drive_change = after - row.drive;
    }
    return row;
}

// Whether the axis asks anything of bodies that can move.
LAW bool row_acts(JointAxis axis, JointRow row) {
    return axis.mode != 0u && row.give > 0.0f;
}
LAW bool is_stopped(uint pin) {
    return (pin & (STOP_LOW | STOP_HIGH)) != 0u;
}
// Whether the row is an unknown of the block's equations.
LAW bool row_is_unknown(JointAxis axis, JointRow row, uint pin, bool biased, Parameters parameters) {
    return is_stopped(pin) || drive_is_solved(axis, row, pin, biased, parameters);
}
// The row with the changes of those of its impulses that are given, not solved for. `speed`: of the row as the pass begins.
LAW JointRow row_given(JointAxis axis, JointRow row, uint pin, float speed, bool biased, Parameters parameters) {
    row.stop_change = is_stopped(pin) ? 0.0f : -row.stop;
    row.drive_change = 0.0f;
    if (!drive_is_solved(axis, row, pin, biased, parameters))
        row.drive_change = held_drive(axis, row, pin, speed, biased, parameters) - row.drive;
    return row;
}
LAW Demand row_demand(JointAxis axis, JointRow row, uint index, uint pin, bool biased, Parameters parameters) {
    if (is_stopped(pin)) return stop_demand(axis, row, index, (pin & STOP_LOW) != 0u, biased, parameters);
    return drive_demand(axis, row, index, biased, parameters);
}

LAWS_END

#endif
