// Joint coordinates and their numerical derivatives.
#include "tests/oracle/dense_joint_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace scree::oracle {

namespace {

using glm::dmat3;
using glm::dquat;
using glm::dvec3;

constexpr double full_drift = 0.0025, no_drift = 0.01;  // rad^2, rotation of a body in a substep

DenseBody body_at(const std::vector<DenseBody>& bodies, std::size_t index) {
    return index == no_dense_body ? DenseBody{} : bodies[index];
}

// The body after a small displacement and rotation (exponential map).
DenseBody displaced(DenseBody body, const dvec3& by, const dvec3& turn) {
    body.position += by;
    const double angle = glm::length(turn);
    if (angle > 0) body.orientation = glm::angleAxis(angle, turn / angle) * body.orientation;
    return body;
}

double derivative(const std::function<double(double)>& f) {
    const double s = 1e-3;
    return (8 * (f(s) - f(-s)) - (f(2 * s) - f(-2 * s))) / (12 * s);
}
double second_derivative(const std::function<double(double)>& f) {
    const double s = 2e-3;
    return (16 * (f(s) + f(-s)) - (f(2 * s) + f(-2 * s)) - 30 * f(0)) / (12 * s * s);
}

dmat3 axes_in_world(const dquat& orientation, const dquat& frame) {
    return glm::mat3_cast(orientation * frame);
}

DenseJacobian row_by_differences(const DenseJoint& joint, std::size_t axis, const DenseBody& a, const DenseBody& b) {
    DenseJacobian row;
    for (int i = 0; i < 3; ++i) {
        dvec3 unit(0);
        unit[i] = 1;
        const auto moved = [&](bool is_b, bool turns) {
            return derivative([&](double s) {
                const dvec3 by = turns ? dvec3(0) : unit * s, turn = turns ? unit * s : dvec3(0);
                return is_b ? coordinates(joint, a, displaced(b, by, turn))[axis]
                            : coordinates(joint, displaced(a, by, turn), b)[axis];
            });
        };
        row.linear_a[i] = moved(false, false);
        row.angular_a[i] = moved(false, true);
        row.linear_b[i] = moved(true, false);
        row.angular_b[i] = moved(true, true);
    }
    return row;
}

// Rows of the two swing components about A's y and z axes: exact without swing, a convention elsewhere.
DenseJacobian swing_row(const DenseJoint& joint, std::size_t axis, const DenseBody& a) {
    const dvec3 about = axes_in_world(a.orientation, joint.frame_a)[static_cast<int>(axis) - 3];
    DenseJacobian row;
    row.angular_b = about;
    row.angular_a = -about;
    return row;
}

}  // namespace

std::array<double, 6> coordinates(const DenseJoint& joint, const DenseBody& a, const DenseBody& b) {
    const dvec3 gap = (b.position + b.orientation * joint.anchor_b) - (a.position + a.orientation * joint.anchor_a);
    const dmat3 axes = axes_in_world(a.orientation, joint.frame_a);
    std::array<double, 6> place{};
    for (int i = 0; i < 3; ++i) place[static_cast<std::size_t>(i)] = glm::dot(axes[i], gap);
    if (joint.radial) place[0] = glm::length(gap);
    // Swing-twist decomposition (Dobrowolski, Swing-twist decomposition in Clifford algebra, 2015): q = swing * twist
    // about x.
    dquat q = glm::inverse(a.orientation * joint.frame_a) * (b.orientation * joint.frame_b);
    if (q.w < 0) q = -q;
    place[3] = 2 * std::atan2(q.x, q.w);
    const dquat twist = glm::normalize(dquat(q.w, q.x, 0, 0));
    const dquat swing = q * glm::inverse(twist);
    const double sine = std::hypot(swing.y, swing.z), angle = 2 * std::atan2(sine, swing.w);
    const double scale = sine > 0 ? angle / sine : 2;
    place[4] = joint.cone ? angle : swing.y * scale;
    place[5] = swing.z * scale;
    return place;
}

DenseRow dense_row(const std::vector<DenseBody>& bodies, const DenseJoint& joint, std::size_t index, std::size_t axis, double h) {
    const DenseBody a = body_at(bodies, joint.a), b = body_at(bodies, joint.b);
    DenseRow row;
    row.joint = index;
    row.axis = axis;
    row.place = coordinates(joint, a, b)[axis];
    const bool by_differences = axis < 4 || joint.cone;
    row.jacobian = by_differences ? row_by_differences(joint, axis, a, b) : swing_row(joint, axis, a);
    if (axis > 3 && joint.spins) {
        const dvec3 own_x = axes_in_world(b.orientation, joint.frame_b)[0];
        const dvec3 twist = row_by_differences(joint, 3, a, b).angular_b;
        const dvec3 about = row.jacobian.angular_b - twist * glm::dot(row.jacobian.angular_b, own_x);
        row.jacobian.angular_b = about;
        row.jacobian.angular_a = -about;
    }
    row.speed = row.jacobian.speed(a, b);
    // Half of the change of the row's velocity over the substep at constant body velocities.
    double gain = 0;
    if (axis < 3)
        gain = second_derivative([&](double t) {
            return coordinates(joint, displaced(a, a.velocity * t, a.spin * t), displaced(b, b.velocity * t, b.spin * t))[axis];
        });
    else
        gain = glm::dot(glm::cross(a.spin, row.jacobian.angular_b), b.spin - a.spin);
    const double turn = std::max(glm::dot(a.spin, a.spin), glm::dot(b.spin, b.spin)) * h * h;
    row.drift = 0.5 * h * gain * std::clamp((no_drift - turn) / (no_drift - full_drift), 0.0, 1.0);
    return row;
}

DensePush dense_response(const DenseBody& body, const dvec3& linear, const dvec3& angular) {
    const dmat3 turn = glm::mat3_cast(body.orientation);
    const dmat3 inverse_inertia =
        turn * dmat3(body.inverse_inertia.x, 0, 0, 0, body.inverse_inertia.y, 0, 0, 0, body.inverse_inertia.z) *
        glm::transpose(turn);
    return {linear * body.inverse_mass, inverse_inertia * angular};
}

double dense_entry(const std::vector<DenseBody>& bodies, const std::vector<DenseJoint>& joints, const DenseRow& left,
                   const DenseRow& right) {
    const DenseJoint &x = joints[left.joint], &y = joints[right.joint];
    double sum = 0;
    const std::pair<std::size_t, std::pair<dvec3, dvec3>> lefts[] = {{x.a, {left.jacobian.linear_a, left.jacobian.angular_a}},
                                                                     {x.b, {left.jacobian.linear_b, left.jacobian.angular_b}}};
    const std::pair<std::size_t, std::pair<dvec3, dvec3>> rights[] = {{y.a, {right.jacobian.linear_a, right.jacobian.angular_a}},
                                                                      {y.b, {right.jacobian.linear_b, right.jacobian.angular_b}}};
    for (const auto& [body_x, row_x] : lefts) {
        for (const auto& [body_y, row_y] : rights) {
            if (body_x == no_dense_body || body_x != body_y) continue;
            const DensePush push = dense_response(bodies[body_x], row_y.first, row_y.second);
            sum += bodies[body_x].split * (glm::dot(row_x.first, push.velocity) + glm::dot(row_x.second, push.spin));
        }
    }
    return sum;
}

}  // namespace scree::oracle
