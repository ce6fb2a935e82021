// Couplings of joints: gears, racks, pulleys, tendons, a joint that follows another.
//
// A coupling is one row over the axes of up to eight joints: its coordinate is the sum of factor times coordinate of these, less
// an offset, and its impulse acts on each of their rows times the factor. So its Jacobian is the sum of theirs, its entries in
// J M^-1 J^T are sums of theirs, and the laws of joint_axis.h give its target, its bounds and its active set: that of a lock, or
// of limits, a spring, a motor, as a tendon has.
//
// In its block a coupling is eliminated behind all joints. Its row is dense, a border of the sparse matrix, so it fills in
// nothing between joints that are otherwise far apart: their elimination stays as it is, and the border is solved with their
// factors (Davis, Direct Methods for Sparse Linear Systems, 2006, ch. 3).
//
// A coupling's record is that of a joint without bodies, whose axes are free:
//   flags          JOINT_COUPLES, the number of terms, and the mode and reach of its axis, which is axes[0] but for the mode
//   fill_in_of     of each term the joint's record times 8, plus the axis; `fill_in` is 0
//   frame_a        factors of the first four terms; with JOINT_CURVED that of the last is the curve's slope at present
//   frame_b        of the other four; with JOINT_CURVED the curve's coefficients
//   anchor_a.x     the offset
//   rows[0]        coordinate and impulses
//   force.x        its load, N, if the axis of its first term is linear, else torque.x, N m
#ifndef SCREE_PHYSICS_JOINT_COUPLING_H
#define SCREE_PHYSICS_JOINT_COUPLING_H

#include "shaders/physics/joint/joint_block.h"

LAWS_BEGIN

CONSTANT uint COUPLING_MODE_SHIFT = 8u;    // in Joint.flags: 8 bits
CONSTANT uint COUPLING_TERMS_SHIFT = 16u;  // 4 bits
CONSTANT uint COUPLING_REACH_SHIFT = 20u;  // 5 bits: those of AXIS_REACH
// Joints of a block with couplings, these included: a coupling has a float for each of their axes, where a joint has its tiles.
CONSTANT uint MAX_COUPLED_BLOCK = 54u;

LAW uint terms_of_coupling(uint flags) {
    return (flags >> COUPLING_TERMS_SHIFT) & 15u;
}
LAW JointAxis axis_of_coupling(JointAxis axis, uint flags) {
    axis.mode = ((flags >> COUPLING_MODE_SHIFT) & 255u) | ((flags >> 12u) & AXIS_REACH);
    return axis;
}
LAW uint reach_of_coupling(uint flags) {
    return (flags >> COUPLING_REACH_SHIFT) & 31u;
}
LAW uint joint_of_term(uint term) {
    return term >> 3u;
}
LAW uint axis_of_term(uint term) {
    return term & 7u;
}

// Of a coupling's terms so far. Whole turns are summed apart: at a thousand turns an angle with them would be known to 1e-4
// rad, and with factors that are numbers of teeth their sum is exact.
struct CoupledSum {
    float coordinate;
    float turns;
    float drift;
    float inverse_effective_mass;
};
LAW CoupledSum with_masses(CoupledSum sum, float factor, JointRow row) {
    sum.drift = sum.drift + factor * row.drift;
    sum.inverse_effective_mass = sum.inverse_effective_mass + (factor * factor) * row.inverse_effective_mass;
    return sum;
}
LAW CoupledSum with_term(CoupledSum sum, float factor, JointRow row, float turns) {
    sum.coordinate = sum.coordinate + factor * row.coordinate;
    sum.turns = sum.turns + factor * turns;
    return with_masses(sum, factor, row);
}
CONSTANT float STEEPEST = 1.0e6f;
CONSTANT uint FARTHEST_REACH = 20u;  // of the least power of two above that
// Value, slope and second derivative of a curve, within bounds.
struct CurvePoint {
    float value;
    float slope;
    float bend;
};
LAW CurvePoint point_of_curve(vec4 curve, float x) {
    CurvePoint at;
    float value = x * (curve.x + x * (curve.y + x * (curve.z + x * curve.w)));
    float slope = curve.x + x * (2.0f * curve.y + x * (3.0f * curve.z + x * (4.0f * curve.w)));
    float bend = 2.0f * curve.y + x * (6.0f * curve.z + x * (12.0f * curve.w));
    at.value = clamped(value, -MOST_ASKED, MOST_ASKED);
    at.slope = clamped(slope, -STEEPEST, STEEPEST);
    at.bend = clamped(bend, -STEEPEST, STEEPEST);
    return at;
}
// `speed`: of the row.
LAW CoupledSum with_curve(CoupledSum sum, CurvePoint at, JointRow row, float speed, float h) {
    sum.coordinate = sum.coordinate + at.value;
    sum.drift = sum.drift + (0.5f * h) * (at.bend * (speed * speed));
    return with_masses(sum, at.slope, row);
}
// The coupling's row; `row` provides its impulses.
LAW JointRow row_of_coupling(JointRow row, CoupledSum sum, float offset) {
    row.direction = vec3(0.0f);
    row.angular_a = vec3(0.0f);
    row.angular_b = vec3(0.0f);
    row.coordinate = flush_tiny((sum.coordinate - offset) + TURN * sum.turns);
    row.drift = flush_tiny(sum.drift);
    row.inverse_effective_mass = flush_least(sum.inverse_effective_mass);
    row.motor_change = 0.0f;
    row.limit_change = 0.0f;
    return row;
}
// Turns in the coordinate of a term: those of the twist.
LAW float turns_of_term(uint axis, float coordinate, float twist) {
    return axis == 3u ? turns_between(coordinate, twist) : 0.0f;
}

// An impulse or a speed, with that of a term.
LAW float with_part(float sum, float factor, float part) {
    return flush_tiny(sum + factor * part);
}
// The size of an impulse along a joint, with that of a term.
LAW float with_push(float sum, float factor, float impulse) {
    return sum + abs(factor * impulse);
}
LAW float with_entry(float sum, float factor, float entry) {
    return flush_least(sum + factor * entry);
}

LAWS_END

#endif
