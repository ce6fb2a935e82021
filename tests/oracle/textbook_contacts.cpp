// Contact points of round shapes from nearest points, partly found by search, and of boxes on planes from vertices.
#include "tests/oracle/textbook_contacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scree::oracle {

using glm::dmat3;
using glm::dvec3;
using glm::dvec4;

double dot_product(dvec3 a, dvec3 b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
dvec3 cross_product(dvec3 a, dvec3 b) {
    return dvec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
double magnitude(dvec3 a) {
    return std::sqrt(dot_product(a, a));
}

dmat3 rotation_matrix(dvec4 q) {
    // Rodrigues: R v = cos(t) v + sin(t) k x v + (1 - cos(t)) k (k.v), with the axis k and the angle t of the quaternion.
    const dvec3 axis_times_sine(q[0], q[1], q[2]);
    const double sine = magnitude(axis_times_sine);
    if (sine == 0) return dmat3(1);
    const dvec3 k = axis_times_sine / sine;
    const double angle = 2 * std::atan2(sine, q[3]);
    dmat3 turn(0);
    for (int column = 0; column < 3; ++column) {
        dvec3 v(0);
        v[column] = 1;
        turn[column] =
            std::cos(angle) * v + std::sin(angle) * cross_product(k, v) + (1 - std::cos(angle)) * dot_product(k, v) * k;
    }
    return turn;
}

namespace {

// A sphere or capsule: a segment (of length 0 for a sphere) with a radius.
struct Round {
    dvec3 start, end;
    double radius;
};
bool is_round(const Shape& shape) {
    return std::holds_alternative<Sphere>(shape) || std::holds_alternative<Capsule>(shape);
}
Round round_of(const Shape& shape, const TextbookPose& pose) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return {pose.position, pose.position, sphere->radius};
    const auto& capsule = std::get<Capsule>(shape);
    const dvec3 half = rotation_matrix(pose.orientation) * dvec3(0, capsule.half_height, 0);
    return {pose.position - half, pose.position + half, capsule.radius};
}

// Minimiser of a convex function on 0..1 by ternary search.
template <typename Function>
double least(Function distance) {
    double low = 0, high = 1;
    for (int i = 0; i < 120; ++i) {
        const double left = low + (high - low) / 3, right = high - (high - low) / 3;
        (distance(left) <= distance(right) ? high : low) = distance(left) <= distance(right) ? right : left;
    }
    return (low + high) / 2;
}
dvec3 along(const Round& round, double t) {
    return round.start + t * (round.end - round.start);
}
dvec3 nearest_on(const Round& round, dvec3 point) {
    if (round.start == round.end) return round.start;
    return along(round, least([&](double t) { return magnitude(along(round, t) - point); }));
}

void add_round_point(dvec3 a, double radius_a, dvec3 b, double radius_b, double reach, std::vector<TextbookPoint>& points) {
    const double apart = magnitude(b - a);
    const dvec3 normal = apart > 0 ? (b - a) / apart : dvec3(0, 1, 0);
    const double separation = apart - radius_a - radius_b;
    if (separation < reach) points.push_back({a + normal * (radius_a + separation / 2), normal, separation});
}

void round_with_round(const Round& a, const Round& b, double reach, std::vector<TextbookPoint>& points) {
    const double reach_a = magnitude(a.end - a.start) / 2 + a.radius, reach_b = magnitude(b.end - b.start) / 2 + b.radius;
    if (magnitude(along(a, 0.5) - along(b, 0.5)) > reach_a + reach_b + reach) return;
    const bool point_a = a.start == a.end;
    const double t = point_a ? 0 : least([&](double s) { return magnitude(along(a, s) - nearest_on(b, along(a, s))); });
    const dvec3 on_a = along(a, t);
    add_round_point(on_a, a.radius, nearest_on(b, on_a), b.radius, reach, points);
}

// Contact of a plane (A) with a sphere; the solid side is behind the normal.
void plane_with_point(const Plane& plane, dvec3 point, double radius, double reach, std::vector<TextbookPoint>& points) {
    const dvec3 normal = dvec3(plane.normal) / magnitude(dvec3(plane.normal));
    const double separation = dot_product(normal, point) - plane.offset - radius;
    if (separation < reach) points.push_back({point - normal * (radius + separation / 2), normal, separation});
}

// Contact of a box (A) with a sphere of this radius at `point`.
void box_with_point(const Box& box, const TextbookPose& pose, dvec3 point, double radius, double reach,
                    std::vector<TextbookPoint>& points) {
    const dmat3 turn = rotation_matrix(pose.orientation);
    dvec3 local(0), nearest(0);
    int shallowest = 0;
    double depth = -1e300;
    for (int axis = 0; axis < 3; ++axis) {
        const double half = box.half_extents[axis];
        local[axis] = dot_product(turn[axis], point - pose.position);
        nearest[axis] = std::clamp(local[axis], -half, half);
        if (std::abs(local[axis]) - half > depth) {
            depth = std::abs(local[axis]) - half;
            shallowest = axis;
        }
    }
    if (depth > 0) {
        add_round_point(pose.position + turn * nearest, 0, point, radius, reach, points);
        return;
    }
    const dvec3 normal = turn[shallowest] * (local[shallowest] < 0 ? -1.0 : 1.0);
    const double separation = depth - radius;
    points.push_back({point - normal * (radius + separation / 2), normal, separation});
}

void box_with_round(const Box& box, const TextbookPose& pose, const Round& round, double reach,
                    std::vector<TextbookPoint>& points) {
    const dmat3 turn = rotation_matrix(pose.orientation);
    const double t = least([&](double s) {
        double squared = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double over = std::abs(dot_product(turn[axis], along(round, s) - pose.position)) - box.half_extents[axis];
            squared += over > 0 ? over * over : 0;
        }
        return squared;
    });
    box_with_point(box, pose, along(round, t), round.radius, reach, points);
    if (round.start == round.end) return;
    if (t > 1e-6) box_with_point(box, pose, round.start, round.radius, reach, points);
    if (t < 1 - 1e-6) box_with_point(box, pose, round.end, round.radius, reach, points);
}

}  // namespace

std::vector<TextbookPoint> textbook_points(const Shape& a, const TextbookPose& pose_a, const Shape& b, const TextbookPose& pose_b,
                                           double reach) {
    std::vector<TextbookPoint> points;
    const auto* plane_a = std::get_if<Plane>(&a);
    const auto* box_a = std::get_if<Box>(&a);
    const auto* box_b = std::get_if<Box>(&b);
    if (is_round(a) && is_round(b)) {
        round_with_round(round_of(a, pose_a), round_of(b, pose_b), reach, points);
    } else if (plane_a && is_round(b)) {
        const Round round = round_of(b, pose_b);
        plane_with_point(*plane_a, round.start, round.radius, reach, points);
        if (round.start != round.end) plane_with_point(*plane_a, round.end, round.radius, reach, points);
    } else if (plane_a && box_b) {
        for (int corner = 0; corner < 8; ++corner) {
            const dvec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            const dvec3 vertex = pose_b.position + rotation_matrix(pose_b.orientation) * (sign * dvec3(box_b->half_extents));
            plane_with_point(*plane_a, vertex, 0, reach, points);
        }
    } else if (box_a && is_round(b)) {
        box_with_round(*box_a, pose_a, round_of(b, pose_b), reach, points);
    } else if ((box_a && box_b) || (plane_a && std::holds_alternative<Plane>(b))) {
        throw std::invalid_argument("textbook_points: knows neither two boxes nor two planes");
    } else {
        points = textbook_points(b, pose_b, a, pose_a, reach);
        for (TextbookPoint& point : points) point.normal = -point.normal;
    }
    return points;
}

}  // namespace scree::oracle
