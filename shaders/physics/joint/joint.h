// Joint kinematics: the coordinates of a joint along and about its six axes, and the Jacobian rows of their rates. The
// targets of rows are in joint_axis.h, the equations of a block in joint_matrix.h and joint_block.h.
//
// A pendulum whose velocity is only projected onto its constraint, moved and projected again would lose (h w)^2 of its
// energy in each substep, half of all in a minute. So the biased pass includes the drift, the second derivative of the
// coordinate times half a substep: the impulses at both ends of a substep are then alike, and the speed that one adds
// the other removes (as in RATTLE: Andersen, J. Comput. Phys. 52, 1983).
#ifndef SCREE_PHYSICS_JOINT_H
#define SCREE_PHYSICS_JOINT_H

#include "shaders/physics/body/periodic_cell.h"
#include "shaders/physics/constraint/wrench.h"

LAWS_BEGIN

// The squared rotation of a body in a substep, rad^2, from which the drift fades (wholly at 0.01): to second order it
// follows slow rotation, but would drive the end of a whip.
CONSTANT float DRIFT_TURN = 0.0025f;
CONSTANT float DRIFT_FADE = 133.33333f;  // 1 / (0.01 - 0.0025)
// Lower bound of 1 + cos(swing), where the twist axis becomes singular (swing near 180 degrees).
CONSTANT float FARTHEST_SWING = 0.05f;

// tan^-1(y/x) for y, x >= 0, not both 0; error 2e-7 (Abramowitz and Stegun 4.4.49).
LAW float angle_of(float y, float x) {
    bool steep = y > x;
    float t = choose(steep, x, y) * reciprocal(larger(choose(steep, y, x), 1.0e-30f));
    float s = t * t;
    float p = 0.0028662257f;
    p = p * s - 0.0161657367f;
    p = p * s + 0.0429096138f;
    p = p * s - 0.0752896400f;
    p = p * s + 0.1065626393f;
    p = p * s - 0.1420889944f;
    p = p * s + 0.1999355085f;
    p = p * s - 0.3333314528f;
    p = t + t * (p * s);
    return choose(steep, 1.5707963f - p, p);
}

// A joint at the present poses; vectors in world axes.
struct JointConfiguration {
    vec3 x;       // the joint's axes fixed in A
    float twist;  // rad
    vec3 y;
    float swing_y;
    vec3 z;
    float swing_z;
    vec3 angular_a;  // from A's centre to its anchor, m
    float turned;    // the twist with its whole turns, rad
    vec3 angular_b;
    vec3 gap;  // from A's anchor to B's, m
    vec3 twist_axis;
    float swing;  // the whole swing, rad
    vec3 swing_axis;
    vec3 x_b;  // B's own x axis
};

LAW JointConfiguration joint_configuration(vec3 anchor_a, vec4 frame_a, Pose a, vec3 anchor_b, vec4 frame_b, Pose b) {
    JointConfiguration at;
    vec4 turn_a = compose(a.orientation, frame_a), turn_b = compose(b.orientation, frame_b);
    Axes axes = axes_of(turn_a);
    at.x = axes.x;
    at.y = axes.y;
    at.z = axes.z;
    at.angular_a = rotate(a.orientation, anchor_a);
    at.angular_b = rotate(b.orientation, anchor_b);
    at.gap = ((b.position - a.position) + at.angular_b) - at.angular_a;
    // q = swing * twist, the twist about x, the swing about an axis perpendicular to x.
    vec4 q = compose(conjugate(turn_a), turn_b);
    q = choose(q.w < 0.0f, -q, q);
    float along = square_root(q.x * q.x + q.w * q.w);
    float half_twist = angle_of(abs(q.x), q.w);
    at.twist = choose(q.x < 0.0f, -2.0f * half_twist, 2.0f * half_twist);
    float unit = reciprocal(larger(along, 1.0e-6f));
    float sy = (q.w * q.y - q.x * q.z) * unit, sz = (q.w * q.z + q.x * q.y) * unit;
    vec3 clean = flush_tiny(vec3(sy, sz, along));  // the sign of zero differs between devices
    sy = clean.x;
    sz = clean.y;
    float across = square_root(sy * sy + sz * sz);
    at.swing = 2.0f * angle_of(across, larger(along, 1.0e-6f));
    bool swings = across > 1.0e-6f;
    float scale = choose(swings, at.swing * reciprocal(larger(across, 1.0e-6f)), 2.0f);
    at.swing_y = sy * scale;
    at.swing_z = sz * scale;
    vec3 about = at.y * sy + at.z * sz;
    at.swing_axis = choose(swings, unit3(about, at.y), at.y);
    // The rate of the twist is w.(xA + xB) / (1 + cos swing).
    vec3 x_b = axes_of(turn_b).x;
    at.x_b = x_b;
    at.twist_axis = (at.x + x_b) * reciprocal(larger(1.0f + dot3(at.x, x_b), FARTHEST_SWING));
    at.turned = at.twist;
    return at;
}

// In a periodic cell, where a joint holds the images whose anchors are nearest to each other.
LAW JointConfiguration at_nearest_image(JointConfiguration at, Parameters parameters) {
    at.gap = at.gap + parameters.period * periods_to_nearest(at.gap, parameters);
    return at;
}

// Centripetal acceleration of B's anchor relative to A's, m/s^2.
LAW vec3 turning_of(JointConfiguration at, VelocityPair v) {
    return cross3(v.b.angular, cross3(v.b.angular, at.angular_b)) - cross3(v.a.angular, cross3(v.a.angular, at.angular_a));
}
// Relative velocity of the anchors (B minus A), m/s.
LAW vec3 anchors_apart(JointConfiguration at, VelocityPair v) {
    return (v.b.linear - v.a.linear) + (cross3(v.b.angular, at.angular_b) - cross3(v.a.angular, at.angular_a));
}

// The factor of the second derivative in the drift: half a substep, times the fading.
LAW float drift_part(VelocityPair v, float h) {
    float fastest = larger(dot3(v.a.angular, v.a.angular), dot3(v.b.angular, v.b.angular)) * (h * h);
    return 0.5f * h * clamped(1.0f - (fastest - DRIFT_TURN) * DRIFT_FADE, 0.0f, 1.0f);
}

// The row of a linear axis; `row` provides its impulses.
LAW JointRow linear_row(JointRow row, JointConfiguration at, int axis, uint flags, VelocityPair v, float h) {
    vec3 speed = anchors_apart(at, v);
    vec3 turning = turning_of(at, v);
    vec3 u = axis == 0 ? at.x : (axis == 1 ? at.y : at.z);
    row.direction = u;
    row.coordinate = dot3(u, at.gap);
    row.angular_a = cross3(at.angular_a + at.gap, u);
    vec3 rate = cross3(v.a.angular, u);
    float second = (dot3(u, turning) + 2.0f * dot3(rate, speed)) + dot3(cross3(v.a.angular, rate), at.gap);
    bool radial = (flags & JOINT_RADIAL) != 0u;
    if (!none(radial)) {
        vec3 outward = unit3(at.gap, at.x);
        float apart = length3(at.gap);
        vec3 around = speed - outward * dot3(speed, outward);
        float curve = dot3(around, around) * reciprocal(larger(apart, 1.0e-3f));
        row.direction = choose(radial, outward, row.direction);
        row.coordinate = choose(radial, apart, row.coordinate);
        row.angular_a = choose(radial, cross3(at.angular_a, outward), row.angular_a);
        second = choose(radial, dot3(outward, turning) + curve, second);
    }
    row.drift = drift_part(v, h) * second;
    row.direction = flush_tiny(row.direction);
    row.angular_a = flush_tiny(row.angular_a);
    row.angular_b = flush_tiny(cross3(at.angular_b, row.direction));
    return row;
}
// The row of an angular axis: 0 is the twist, 1 and 2 the swing.
LAW JointRow angular_row(JointRow row, JointConfiguration at, int axis, uint flags, VelocityPair v, float h) {
    bool cone = (flags & JOINT_CONE) != 0u;
    vec3 u = axis == 0 ? at.twist_axis : (axis == 1 ? choose(cone, at.swing_axis, at.y) : at.z);
    // Removes the twist from a swing axis: B may spin about its own x axis without swinging (a steered wheel).
    if (axis != 0) u = choose((flags & JOINT_SPINS) != 0u, u - at.twist_axis * dot3(u, at.x_b), u);
    u = flush_tiny(u);
    row.direction = u;
    row.coordinate = axis == 0 ? at.twist : (axis == 1 ? choose(cone, at.swing, at.swing_y) : at.swing_z);
    row.angular_a = u;
    row.angular_b = u;
    row.drift = drift_part(v, h) * dot3(cross3(v.a.angular, u), v.b.angular - v.a.angular);
    return row;
}

LAW bool is_linear(uint axis) {
    return axis < 3u;
}
// J v: the rate of the coordinate.
LAW float row_speed(JointRow row, bool linear, VelocityPair v) {
    float turning = dot3(row.angular_b, v.b.angular) - dot3(row.angular_a, v.a.angular);
    return choose(linear, dot3(row.direction, v.b.linear - v.a.linear) + turning, turning);
}
// The velocity after an impulse along (linear) or about the row. `turn`: I^-1 of its angular part, not yet split.
LAW Velocity row_turned(Velocity v, vec3 direction, vec3 turn, float impulse, bool linear, Mass mass) {
    v.linear = choose(linear, flush_tiny(v.linear + direction * (impulse * mass.inverse_mass * mass.split)), v.linear);
    v.angular = flush_tiny(v.angular + turn * (impulse * mass.split));
    return v;
}
LAW Velocity row_pushed(Velocity v, vec3 direction, vec3 arm, float impulse, bool linear, Mass mass) {
    return row_turned(v, direction, turned_by(mass, arm), impulse, linear, mass);
}

LAWS_END

#endif
