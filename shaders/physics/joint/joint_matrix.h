// The equations of a block of joints: Jacobian rows at the present poses, entries of J M^-1 J^T, elimination. In SIMD a
// lane is a joint or an axis of one.
#ifndef SCREE_PHYSICS_JOINT_MATRIX_H
#define SCREE_PHYSICS_JOINT_MATRIX_H

#include "shaders/physics/joint/joint.h"

LAWS_BEGIN

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
    return response;
}

// Which bodies two joints share: A or B of the one is A or B of the other. At most two bits are set.
CONSTANT int ENDS_A_A = 1;
CONSTANT int ENDS_A_B = 2;
CONSTANT int ENDS_B_A = 4;
CONSTANT int ENDS_B_B = 8;
// The part of an entry due to one shared body: the row's speed from an impulse of 1 along the other row.
LAW float entry_through(vec3 direction, vec3 arm, vec3 other_direction, vec3 other_turn, bool both_linear, float inverse_mass,
                        float split) {
    float turning = dot3(arm, other_turn);
    return choose(both_linear, dot3(direction, other_direction) * inverse_mass + turning, turning) * split;
}
// The entry of J M^-1 J^T for a row with this direction and these angular parts, and the row of `to`.
LAW float row_entry(vec3 direction, vec3 angular_a, vec3 angular_b, uint axis, RowResponse to, int ends) {
    bool linear = is_linear(axis) && is_linear(to.axis);
    float sum = 0.0f;
    if ((ends & ENDS_A_A) != 0)
        sum = entry_through(direction, angular_a, to.direction, to.turn_a, linear, to.inverse_mass_a, to.split_a);
    if ((ends & ENDS_A_B) != 0) {
        float entry = -entry_through(direction, angular_a, to.direction, to.turn_b, linear, to.inverse_mass_b, to.split_b);
        sum = (ends & ENDS_A_A) != 0 ? sum + entry : entry;
    }
    if ((ends & ENDS_B_A) != 0) {
        float entry = -entry_through(direction, angular_b, to.direction, to.turn_a, linear, to.inverse_mass_a, to.split_a);
        sum = (ends & (ENDS_A_A | ENDS_A_B)) != 0 ? sum + entry : entry;
    }
    if ((ends & ENDS_B_B) != 0) {
        float entry = entry_through(direction, angular_b, to.direction, to.turn_b, linear, to.inverse_mass_b, to.split_b);
        sum = ends != ENDS_B_B ? sum + entry : entry;
    }
    return flush_least(sum);
}

// The inverse effective mass of a row of two split bodies, of which `has_a` and `has_b` can move.
LAW float inverse_effective_mass(JointRow row, uint axis, Mass a, Mass b, bool has_a, bool has_b) {
    RowResponse to = row_response(row, axis, a, b);
    bool linear = is_linear(axis);
    float of_a = entry_through(row.direction, row.angular_a, to.direction, to.turn_a, linear, to.inverse_mass_a, to.split_a);
    float of_b = entry_through(row.direction, row.angular_b, to.direction, to.turn_b, linear, to.inverse_mass_b, to.split_b);
    return flush_least(choose(has_a, choose(has_b, of_a + of_b, of_a), choose(has_b, of_b, 0.0f)));
}

// The inverse effective mass of an axis that turns a rotor, too (armature).
LAW float with_rotor_inertia(float inverse_mass, float rotor_inertia) {
    return inverse_mass * reciprocal(1.0f + inverse_mass * rotor_inertia);
}

// The row of axis k at the present poses with its inverse effective mass (`a`, `b`: split bodies).
LAW JointRow placed_row(JointRow row, JointConfiguration at, int k, uint flags, VelocityPair v, Mass a, Mass b, bool has_a,
                        bool has_b, float rotor_inertia, float h) {
    if (k < 3)
        row = linear_row(row, at, k, flags, v, h);
    else
        row = angular_row(row, at, k - 3, flags, v, h);
    row.coordinate = flush_tiny(row.coordinate);
    row.drift = flush_tiny(row.drift);
    row.inverse_effective_mass = with_rotor_inertia(inverse_effective_mass(row, uint(k), a, b, has_a, has_b), rotor_inertia);
    row.motor_change = 0.0f;
    row.limit_change = 0.0f;
    return row;
}

// ---- elimination and substitution
LAW float right_hand_side(float speed, float bias) {
    return -flush_tiny(speed + bias);
}
// The diagonal entry of a row with its compliance. That of a heavy rotor or a stiff spring would be lost beside the entry, and
// rows that share their bodies' freedom would have no pivot: two hinges of one axis with rotors of a million times the link's
// inertia ended in quarantine. With this least compliance a row keeps 1e-5 of what it changes of its bodies' speed; with 1e-6
// rounding is a tenth of such pivots.
CONSTANT float LEAST_COMPLIANCE = 1.0e-5f;  // relative to the entry
LAW float softened(float entry, float compliance) {
    return entry + larger(compliance, LEAST_COMPLIANCE * entry);
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

LAWS_END

#endif
