// The normal rows of a contact's points, as three scalars.
//
// The points of a contact share the normal n and lie in one plane. A point's height over that plane gives an impulse along n no
// moment, so along n the bodies approach at the point (u, v), measured from the centre of the patch, with the speed
// s0 + u s1 + v s2: s0 at the centre, s1 and s2 by their relative rotation. Impulses p_k at points (u_k, v_k) act as
// (sum p_k, sum p_k u_k, sum p_k v_k) on these three, through one symmetric 3 x 3 matrix: the inverse effective mass of the
// contact. So the points are solved in scalars, and the bodies' velocities are changed once for all of them.
#ifndef SCREE_PHYSICS_NORMAL_ROWS_H
#define SCREE_PHYSICS_NORMAL_ROWS_H

#include "shaders/physics/constraint/wrench.h"

LAWS_BEGIN

// (s0, s1, s2): m/s, 1/s, 1/s. `d`: centre of B minus centre of A, m.
LAW vec3 normal_speeds(Constraint c, vec3 d, VelocityPair v) {
    LeverArms r = lever_arms(c, c.centre, d);
    vec3 u = tangent(c.normal), spin = v.b.angular - v.a.angular;
    float turning = dot3(cross3(r.b, c.normal), v.b.angular) - dot3(cross3(r.a, c.normal), v.a.angular);
    return vec3(dot3(c.normal, v.b.linear - v.a.linear) + turning, -dot3(cross3(c.normal, u), spin), dot3(u, spin));
}
// At point k, m/s.
LAW float speed_at(Constraint c, vec3 speeds, int k) {
    return speeds.x + (c.points_u[k] * speeds.y + c.points_v[k] * speeds.z);
}
// (p, p u, p v) of an impulse at point k, N s and N m s.
LAW vec3 press_at(Constraint c, float impulse, int k) {
    return vec3(impulse, impulse * c.points_u[k], impulse * c.points_v[k]);
}

struct NormalRows {
    vec3 at_centre, along_u, along_v;  // rows of the inverse effective mass of the split bodies
};
LAW NormalRows normal_rows(Constraint c, vec3 d, Mass a, Mass b) {
    LeverArms r = lever_arms(c, c.centre, d);
    vec3 arm_a = cross3(r.a, c.normal), arm_b = cross3(r.b, c.normal);
    NormalRows rows;
    vec3 u = tangent(c.normal), v = cross3(c.normal, u);
    vec3 response_a = turned_by(a, arm_a), response_b = turned_by(b, arm_b);
    float k00 = (a.inverse_mass + dot3(arm_a, response_a)) * a.split + (b.inverse_mass + dot3(arm_b, response_b)) * b.split;
    vec3 turning = response_a * a.split + response_b * b.split;
    Mass both = a;
    both.xx = a.xx * a.split + b.xx * b.split;
    both.xy = a.xy * a.split + b.xy * b.split;
    both.xz = a.xz * a.split + b.xz * b.split;
    both.yy = a.yy * a.split + b.yy * b.split;
    both.yz = a.yz * a.split + b.yz * b.split;
    both.zz = a.zz * a.split + b.zz * b.split;
    vec3 about_u = turned_by(both, u), about_v = turned_by(both, v);
    float k01 = -dot3(v, turning), k02 = dot3(u, turning), k12 = -dot3(u, about_v);
    rows.at_centre = vec3(k00, k01, k02);
    rows.along_u = vec3(k01, dot3(v, about_v), k12);
    rows.along_v = vec3(k02, k12, dot3(u, about_u));
    return rows;
}
// What an impulse of 1 at point k changes of the three speeds.
LAW vec3 response_at(NormalRows rows, Constraint c, int k) {
    return rows.at_centre + (rows.along_u * c.points_u[k] + rows.along_v * c.points_v[k]);
}
LAW vec3 response_to(NormalRows rows, vec3 press) {
    return rows.at_centre * press.x + (rows.along_u * press.y + rows.along_v * press.z);
}
// What impulses along the normal exert. `press`: their sum by press_at().
LAW Wrench wrench_of_press(Constraint c, vec3 press) {
    vec3 u = tangent(c.normal);
    Wrench wrench;
    wrench.push = c.normal * press.x;
    wrench.moment = u * press.z - cross3(c.normal, u) * press.y;
    return wrench;
}
// After the normal impulses of a pass. `speeds`: those that they leave.
LAW SolveResult result_of(Constraint c, Impulse impulse, vec3 speeds, vec3 press) {
    SolveResult result;
    result.impulse = impulse;
    result.speeds = speeds;
    result.wrench = wrench_of_press(c, press);
    result.restarts = vec4(0.0f);
    return result;
}

LAWS_END

#endif
