// Whole turns of a joint's angles. Poses tell angles between half a turn either way; a limit or a spring may be anywhere.
//
// The twist is counted: a joint keeps it with its whole turns, and takes the nearest that the poses allow (no two bodies turn
// against each other by more than Settings::max_turn allows, less than half a turn in a substep). Swings are not: B swings by
// more than half a turn where it would be as near the other way round, and of both ways the one counts that strains limits, locks
// and springs less. So does the twist where B may swing half a turn about any axis: near there it turns with the swing's
// direction.
#ifndef SCREE_PHYSICS_JOINT_TURNS_H
#define SCREE_PHYSICS_JOINT_TURNS_H

#include "shaders/physics/joint/joint.h"

LAWS_BEGIN

CONSTANT float TURN = 6.2831853f;  // rad
CONSTANT float INVERSE_TURN = 0.15915494f;
// A turn in two parts: up to 65,536 times the first is exact, so a limit holds at a hundred turns as it does at one.
CONSTANT float TURN_HIGH = 6.28125f;
CONSTANT float TURN_LOW = 0.0019353072f;
CONSTANT float MOST_TURNS = 1.0e6f;  // beyond, turns are no longer counted: an int and a float's digits end
// Least swing, rad, that counts the other way round: the direction of a lesser one is lost in rounding.
CONSTANT float LEAST_SWING = 1.0f;

// Whole turns from `wrapped` to the angle congruent with it that is nearest to `angle`. NaN gives 0 everywhere.
LAW float turns_between(float wrapped, float angle) {
    float turns = (angle - wrapped) * INVERSE_TURN;
    return float(whole(choose(abs(turns) < MOST_TURNS, turns, 0.0f) + 0.5f));
}
LAW float with_turns(float angle, float turns) {
    return angle + turns * TURN;
}
LAW float less_turns(float angle, float turns) {
    return (angle - turns * TURN_HIGH) - turns * TURN_LOW;
}

// Where a lock, limits or else a spring want the coordinate.
LAW float wanted_coordinate(JointAxis axis, float coordinate) {
    bool at_rest = (axis.mode & AXIS_LOCKED) != 0u || (axis.mode & (AXIS_LIMITED | AXIS_SPRING)) == AXIS_SPRING;
    return choose(at_rest, axis.rest, clamped(coordinate, axis.lower, axis.upper));
}
LAW float strain_of(JointAxis axis, float coordinate) {
    return abs(coordinate - wanted_coordinate(axis, coordinate));
}

LAW bool counts_turns(uint flags, JointAxis twist) {
    return (flags & JOINT_SWINGS) == 0u && (twist.mode & AXIS_LOCKED) == 0u;
}
// Counts the twist on from where it was, and takes the swing the way round that strains its axes less.
LAW JointConfiguration turned_configuration(JointConfiguration at, uint flags, float twist_before, JointAxis twist,
                                            JointAxis swing_y, JointAxis swing_z) {
    float expected = choose(counts_turns(flags, twist), twist_before, wanted_coordinate(twist, at.twist));
    at.turned = flush_tiny(with_turns(at.twist, turns_between(at.twist, expected)));
    bool other_way = at.swing > LEAST_SWING && (flags & JOINT_CONE) == 0u;
    if (none(other_way)) return at;
    float scale = 1.0f - TURN * reciprocal(larger(at.swing, LEAST_SWING));
    float y = at.swing_y * scale, z = at.swing_z * scale;
    float strain = strain_of(swing_y, at.swing_y) + strain_of(swing_z, at.swing_z);
    other_way = other_way && strain_of(swing_y, y) + strain_of(swing_z, z) < strain;
    at.swing_y = choose(other_way, y, at.swing_y);
    at.swing_z = choose(other_way, z, at.swing_z);
    return at;
}
// The axis of a twist whose row has the coordinate `wrapped`: its limits and its rest, less the turns made.
LAW JointAxis axis_after_turns(JointAxis axis, float turned, float wrapped) {
    float turns = turns_between(wrapped, turned);
    axis.lower = less_turns(axis.lower, turns);
    axis.upper = less_turns(axis.upper, turns);
    axis.rest = less_turns(axis.rest, turns);
    return axis;
}

LAWS_END

#endif
