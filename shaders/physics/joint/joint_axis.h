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

#include "shaders/physics/joint/joint_turns.h"

LAWS_BEGIN

// Baumgarte factor: the part of the position error corrected per substep. With 1, a joint held open by contacts shakes.
CONSTANT float JOINT_RATE = 0.25f;
CONSTANT float JOINT_TURN_SPEED = 6.0f;  // rad/s, greatest angular correction
// Compliance of rigid rows, relative to their inverse effective mass: mechanisms have redundant joints, and without
// compliance their equations are singular. More stretches chains; less lets the redundant part grow from rounding.
CONSTANT float JOINT_COMPLIANCE = 1.0e-3f;
// Baumgarte factor and compliance of a graph that is cut into blocks (JOINT_CUT). A pass is one iteration over the blocks: what
// it leaves of the correction's speed is energy, and impulses that oppose each other across a cut grow.
CONSTANT float CUT_RATE = 0.05f, CUT_COMPLIANCE = 1.0e-2f;
CONSTANT float GENTLE_SPRING = 0.25f;  // stability limit of explicit springs: softer ones act as forces

struct RowTarget {  // row speed + bias + compliance * impulse's change = 0
    float bias;
    float compliance;
};

LAW bool is_cut(JointAxis axis) {
    return (axis.mode & AXIS_CUT) != 0u;
}
// How far a coupling's coordinate goes while a joint of it goes 1 m or rad, as a power of two; 1 of other axes.
LAW float reach_of(JointAxis axis) {
    return uintBitsToFloat(((axis.mode & AXIS_REACH) << 15u) + 0x3F800000u);
}
// Bias velocity that corrects a position error (Baumgarte), limited, m/s or rad/s.
LAW float joint_push(float coordinate, JointAxis axis, uint index, Parameters parameters) {
    float fastest = choose(is_linear(index), parameters.push_speed, JOINT_TURN_SPEED) * reach_of(axis);
    return clamped(coordinate * (choose(is_cut(axis), CUT_RATE, JOINT_RATE) * parameters.inverse_h), -fastest, fastest);
}
LAW float rigid_compliance(JointAxis axis, JointRow row) {
    return choose(is_cut(axis), CUT_COMPLIANCE, JOINT_COMPLIANCE) * row.inverse_effective_mass;
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

LAW bool is_locked(JointAxis axis) {
    return (axis.mode & AXIS_LOCKED) != 0u;
}
LAW bool has_spring(JointAxis axis) {
    return (axis.mode & AXIS_SPRING) != 0u;
}
LAW bool has_motor(JointAxis axis) {
    return (axis.mode & AXIS_MOTOR) != 0u;
}
LAW bool is_at_lower(uint active_flags) {
    return (active_flags & LIMIT_LOWER) != 0u;
}
LAW bool is_stopped(uint active_flags) {
    return (active_flags & (LIMIT_LOWER | LIMIT_UPPER)) != 0u;
}

// A spring beside a motor, or beside dry friction, a motor of speed 0: the motor's bounds are about the impulse of the spring,
// so what sticks bears both, and what slides the spring and the whole friction. Springs that are too stiff to act
// explicitly are taken implicitly, as if the row were alone.
LAW bool has_spring_and_motor(JointAxis axis) {
    return has_spring(axis) && has_motor(axis);
}
LAW float share_of_spring(JointAxis axis, JointRow row, float speed, Parameters parameters) {
    bool both = has_spring_and_motor(axis);
    if (none(both)) return 0.0f;
    float h = parameters.h, pull = axis.stiffness * (axis.rest - row.coordinate), resisting = axis.damping + h * axis.stiffness;
    float given = (pull - axis.damping * speed) * h;
    float implied = (pull - resisting * speed) * (h * reciprocal(1.0f + h * resisting * row.inverse_effective_mass));
    return choose(both, choose(is_gentle(axis, row.inverse_effective_mass, parameters), given, implied), 0.0f);
}

// Bounds of the impulse of a motor or spring that moves as it should.
LAW float least_of_motor(JointAxis axis, JointRow row, Parameters parameters) {
    float most = most_impulse(axis, parameters);
    return choose(has_spring_and_motor(axis), share_of_spring(axis, row, axis.speed, parameters) - most, -most);
}
LAW float most_of_motor(JointAxis axis, JointRow row, Parameters parameters) {
    float most = most_impulse(axis, parameters);
    return choose(has_spring_and_motor(axis), share_of_spring(axis, row, axis.speed, parameters) + most, most);
}

// Whether the motor impulse is an unknown of the block's equations; if not, saturated_motor_impulse() gives it.
LAW bool motor_is_solved(JointAxis axis, JointRow row, uint active_flags, bool biased, Parameters parameters) {
    bool saturated = (active_flags & (MOTOR_AT_MIN | MOTOR_AT_MAX)) != 0u;
    bool answers = has_motor(axis) || (has_spring(axis) && biased && !is_gentle(axis, row.inverse_effective_mass, parameters));
    return !is_stopped(active_flags) && (is_locked(axis) || (!saturated && answers));
}
// The motor impulse of a row that does not solve for it. `speed`: of the row as the pass begins.
LAW float saturated_motor_impulse(JointAxis axis, JointRow row, uint active_flags, float speed, bool biased,
                                  Parameters parameters) {
    float most = most_impulse(axis, parameters);
    bool stopped = is_stopped(active_flags), at_min = (active_flags & MOTOR_AT_MIN) != 0u, sprung = has_spring(axis);
    float impulse = choose(at_min, -most, choose((active_flags & MOTOR_AT_MAX) != 0u, most, 0.0f));
    float stalled = choose(axis.speed > 0.0f, most, choose(axis.speed < 0.0f, -most, clamped(row.motor_impulse, -most, most)));
    impulse = choose(has_motor(axis) && stopped, stalled, impulse);
    if (none(sprung)) return impulse;
    float felt = choose(stopped, 0.0f, speed);
    bool explicitly = stopped || is_gentle(axis, row.inverse_effective_mass, parameters);
    float of_spring = choose(explicitly, spring_impulse(axis, row.coordinate, felt, parameters), impulse);
    float share = share_of_spring(axis, row, felt, parameters);
    bool pushes_back = (stopped && axis.speed < 0.0f) || (!stopped && at_min);
    float of_both = choose(stopped && axis.speed == 0.0f, clamped(row.motor_impulse, share - most, share + most),
                           choose(pushes_back, share - most, share + most));
    float sprung_impulse = choose(biased, choose(has_motor(axis), of_both, of_spring), row.motor_impulse);
    return choose(sprung, sprung_impulse, impulse);
}
// The equation of a lock, spring or motor.
LAW RowTarget motor_target(JointAxis axis, JointRow row, uint index, bool biased, Parameters parameters) {
    RowTarget demand;
    demand.compliance = rigid_compliance(axis, row);
    float correction =
        (joint_push(row.coordinate - axis.rest, axis, index, parameters) + row.drift) + demand.compliance * row.motor_impulse;
    demand.bias = choose(is_locked(axis), choose(biased, correction, 0.0f), -axis.speed);
    bool sprung = has_spring(axis) && !has_motor(axis) && !is_locked(axis);
    if (none(sprung)) return demand;
    float resisting = axis.damping + parameters.h * axis.stiffness;
    float yielding = reciprocal(resisting);
    demand.compliance = choose(sprung, yielding * parameters.inverse_h, demand.compliance);
    float resistance = (axis.stiffness * (row.coordinate - axis.rest) - axis.damping * axis.speed) * yielding +
                       demand.compliance * row.motor_impulse;
    demand.bias = choose(sprung, resistance, demand.bias);
    return demand;
}
// Bias of a limit: speculative while there is room, else the correction of the violation in the biased pass.
LAW float limit_bias(float room, float drift, JointAxis axis, uint index, bool biased, Parameters parameters) {
    float ahead = room * parameters.inverse_h + choose(biased, drift, 0.0f);
    return choose(room > 0.0f, ahead, choose(biased, joint_push(room, axis, index, parameters) + drift, 0.0f));
}
// The equation of the lower limit if `low`, else of the upper, whose speed and impulse are negative. It yields to the net impulse
// of the row, so that a motor or spring that presses against the stop does not push through it.
LAW RowTarget limit_target(JointAxis axis, JointRow row, uint index, bool low, bool biased, Parameters parameters) {
    RowTarget demand;
    demand.compliance = rigid_compliance(axis, row);
    float room = choose(low, row.coordinate - axis.lower, axis.upper - row.coordinate);
    float bias = limit_bias(room, choose(low, row.drift, -row.drift), axis, index, biased, parameters);
    bias = choose(low, bias, -bias);
    demand.bias = choose(biased, bias + demand.compliance * (row.limit_impulse + (row.motor_impulse + row.motor_change)), bias);
    return demand;
}

// The active set of an axis after a solution: of its motor, of limits that are not active, and of active ones. `speed`: of
// the row afterwards; `solution`: of the row, if it was an unknown.
LAW uint motor_flags_after(JointAxis axis, JointRow row, uint index, uint active_flags, bool solved, float solution, float speed,
                           bool biased, bool settling, Parameters parameters) {
    bool changeable = (has_motor(axis) || has_spring(axis)) && !is_locked(axis);
    if (none(changeable)) return active_flags;
    float impulse = row.motor_impulse + solution;
    uint bound = choose(impulse < least_of_motor(axis, row, parameters), MOTOR_AT_MIN,
                        choose(impulse > most_of_motor(axis, row, parameters), MOTOR_AT_MAX, 0u));
    uint after = choose(changeable && solved, bound, active_flags);
    bool saturated = changeable && !solved && active_flags != 0u && !settling && (biased || !has_spring(axis));
    if (none(saturated)) return after;
    float error = speed + motor_target(axis, row, index, biased, parameters).bias;
    bool freed = ((active_flags & MOTOR_AT_MIN) != 0u && error < 0.0f) || ((active_flags & MOTOR_AT_MAX) != 0u && error > 0.0f);
    return choose(saturated && freed, 0u, after);
}
LAW uint limit_flags_after(JointAxis axis, JointRow row, uint index, uint active_flags, float speed, bool biased,
                           Parameters parameters) {
    float low = speed + limit_target(axis, row, index, true, biased, parameters).bias;
    float high = speed + limit_target(axis, row, index, false, biased, parameters).bias;
    return choose(low < 0.0f, LIMIT_LOWER, choose(high > 0.0f, LIMIT_UPPER, active_flags));
}
LAW uint active_set_after(JointAxis axis, JointRow row, uint index, uint active_flags, bool solved, float solution, float speed,
                          bool biased, bool settling, Parameters parameters) {
    bool stopped = is_stopped(active_flags);
    float impulse = row.limit_impulse + solution;
    bool freed = choose(is_at_lower(active_flags), impulse, -impulse) < 0.0f;
    uint after =
        choose(stopped && freed, active_flags & ~(choose(is_at_lower(active_flags), LIMIT_LOWER, LIMIT_UPPER)), active_flags);
    if (none(!stopped)) return after;
    uint moving = motor_flags_after(axis, row, index, active_flags, solved, solution, speed, biased, settling, parameters);
    bool limited = (axis.mode & AXIS_LIMITED) != 0u && !settling;
    if (!none(limited)) moving = choose(limited, limit_flags_after(axis, row, index, moving, speed, biased, parameters), moving);
    return choose(stopped, after, moving);
}
LAW uint active_set_of(uint active_set, uint axis) {
    return (active_set >> (4u * axis)) & 15u;
}
LAW uint with_active_set(uint active_set, uint axis, uint active_flags) {
    return (active_set & ~(15u << (4u * axis))) | (active_flags << (4u * axis));
}

// Changes of the row's impulses, clamped to their bounds.
LAW JointRow row_after(JointRow row, JointAxis axis, uint active_flags, bool solved, float solution, Parameters parameters) {
    bool stopped = is_stopped(active_flags);
    float limit = flush_tiny(row.limit_impulse + solution), motor = flush_tiny(row.motor_impulse + solution);
    limit = choose(is_at_lower(active_flags), positive(limit), -positive(-limit));
    row.limit_change = choose(solved && stopped, limit - row.limit_impulse, row.limit_change);
    bool bounded = solved && !stopped && !is_locked(axis);
    if (!none(bounded)) {
        float least = least_of_motor(axis, row, parameters), most = most_of_motor(axis, row, parameters);
        motor = choose(bounded, clamped(motor, least, most), motor);
    }
    row.motor_change = choose(solved && !stopped, motor - row.motor_impulse, row.motor_change);
    return row;
}

// Whether the axis constrains a body that can move.
LAW bool row_acts(JointAxis axis, JointRow row) {
    return axis.mode != 0u && row.inverse_effective_mass > 0.0f;
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
    row.limit_change = choose(is_stopped(active_flags), 0.0f, -row.limit_impulse);
    row.motor_change = 0.0f;
    bool given = !motor_is_solved(axis, row, active_flags, biased, parameters);
    if (none(given)) return row;
    float impulse = flush_tiny(saturated_motor_impulse(axis, row, active_flags, speed, biased, parameters));
    row.motor_change = choose(given, impulse - row.motor_impulse, row.motor_change);
    return row;
}
LAW float given_change(JointRow row) {
    return row.motor_change + row.limit_change;
}
// What is given pushes the bodies before the equations are solved, but a rotor takes it.
LAW float given_push(JointAxis axis, JointRow row) {
    return choose(has_rotor(axis), 0.0f, given_change(row));
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
    RowTarget demand = motor_target(axis, row, index, biased, parameters);
    bool stopped = is_stopped(active_flags), turns = has_rotor(axis);
    if (!none(stopped)) {
        RowTarget limit = limit_target(axis, row, index, is_at_lower(active_flags), biased, parameters);
        demand.bias = choose(stopped, limit.bias, demand.bias);
        demand.compliance = choose(stopped, limit.compliance, demand.compliance);
    }
    if (none(turns)) return demand;
    bool alone = !axis_is_solved(axis, row, active_flags, biased, parameters);
    RowTarget joined = with_rotor(demand, rotor, given_change(row)), own;
    own.compliance = reciprocal(rotor.inertia);
    own.bias = -(rotor.speed + given_change(row) * own.compliance);
    demand.bias = choose(turns, choose(alone, own.bias, joined.bias), demand.bias);
    demand.compliance = choose(turns, choose(alone, own.compliance, joined.compliance), demand.compliance);
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
    rotor.speed = choose(were_set, axis_speed, choose(at_rest, 0.0f, rotor.speed));
    return rotor;
}
// What a row may ask for, m/s or rad/s. Bodies are not as fast as a joint asks at the ends of the ranges (held_velocity), and it
// then asks for more in every substep.
CONSTANT float MOST_ASKED = 1.0e9f;
// The sum of a row's or rotor's impulses, within what changes the row's speed by that.
LAW float bounded_impulse(float impulse, JointRow row) {
    float most = MOST_ASKED * reciprocal(larger(row.inverse_effective_mass, 1.0e-20f));
    return clamped(impulse, -most, most);
}
// The rotor after its impulse on the axis.
LAW JointRotor rotor_slowed(JointRotor rotor, float impulse) {
    rotor.speed = clamped(flush_tiny(rotor.speed - impulse * reciprocal(rotor.inertia)), -MOST_ASKED, MOST_ASKED);
    return rotor;
}
// Adds the change of the pass to the impulse, which warm starts the next substep if it `warms`. `row`: with its changes added.
LAW JointRotor rotor_after_pass(JointRotor rotor, JointRow row, bool warms) {
    rotor = rotor_slowed(rotor, rotor.change - given_change(row));
    rotor.impulse = bounded_impulse(flush_tiny(rotor.impulse + rotor.change), row);
    rotor.change = 0.0f;
    rotor.speed = choose(warms, rotor_slowed(rotor, impulse_of_rotor(row, rotor)).speed, rotor.speed);
    return rotor;
}
// The rotor when the impulse of its motor is taken back.
LAW JointRotor rotor_without_motor(JointRotor rotor, JointRow row) {
    rotor.impulse = choose(rotor.inertia > 0.0f, flush_tiny(rotor.impulse - row.motor_impulse), rotor.impulse);
    return rotor;
}

LAWS_END

#endif
