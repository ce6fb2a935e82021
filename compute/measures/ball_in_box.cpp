// The volume of a ball within a box: the theorem of Gauss and Bonnet gives the area of the sphere's part beyond one, two or three
// planes at right angles, that of Gauss the volume; the eight corners of the box are added up with their signs. Errors are some
// 1e-15 of the ball's volume.
#include "compute/measures/ball_in_box.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"

namespace scree {

namespace {

constexpr double pi = std::numbers::pi;

double root(double x) {
    return std::sqrt(std::max(x, 0.0));
}

// Of the unit ball, what is beyond planes at distances in 0 .. 1 along axes at right angles.
double beyond(double a) {
    return pi * (2 + a * (a * a - 3)) / 3;
}
// The exterior angle where the sphere's circles at a and b meet; `rest`: 1 - a^2 - b^2.
double turn_at(double a, double b, double rest) {
    return portable::atan2(root(rest), -a * b);
}
double beyond(double a, double b) {
    const double rest = 1 - a * a - b * b;
    if (rest <= 0) return 0;
    const double half = root(rest);  // of the chord that both planes share
    // Of the disc at a, which has the radius sqrt(1 - a^2): the angle of its part beyond b, and that part's area.
    const auto angle = [&](double of) { return 2 * portable::atan2(half, of); };
    const double at_a = angle(b), at_b = angle(a);
    const double area_a = 0.5 * ((1 - a * a) * at_a - 2 * b * half), area_b = 0.5 * ((1 - b * b) * at_b - 2 * a * half);
    const double sphere = 2 * pi - a * at_a - b * at_b - 2 * turn_at(a, b, rest);
    return std::max(0.0, (sphere - a * area_a - b * area_b) / 3);
}
double beyond(double a, double b, double c) {
    if (1 - a * a - b * b - c * c <= 0) return 0;
    double sphere = 2 * pi, discs = 0;
    const double planes[3] = {a, b, c};
    for (int k = 0; k < 3; ++k) {
        const double d = planes[k], e = planes[(k + 1) % 3], f = planes[(k + 2) % 3];
        const double squared = 1 - d * d;  // of the disc's radius
        const double beside_e = root(squared - e * e), beside_f = root(squared - f * f);
        const double angle = portable::atan2(beside_e, e) - portable::atan2(f, beside_f);
        const double area = 0.5 * (squared * angle - e * (beside_e - f) - f * (beside_f - e));
        sphere -= d * angle + turn_at(d, e, 1 - d * d - e * e);
        discs += d * area;
    }
    return std::max(0.0, (sphere - discs) / 3);
}

// At any distances: what is beyond a negative one is all but its mirror image.
double beyond_all(double a, double b, double c) {
    if (a >= 1 || b >= 1 || c >= 1) return 0;
    const auto two = [](double d, double e) {
        const double both = d > -1 && e > -1 ? beyond(std::abs(d), std::abs(e)) : 0;
        const auto one = [](double x) { return x <= -1 ? 4 * pi / 3 : x < 0 ? 4 * pi / 3 - beyond(-x) : beyond(x); };
        if (d >= 0) return e >= 0 ? both : e <= -1 ? one(d) : beyond(d) - both;
        if (e >= 0) return d <= -1 ? one(e) : beyond(e) - both;
        if (d <= -1) return one(e);
        if (e <= -1) return one(d);
        return one(d) - (beyond(-e) - both);
    };
    if (a <= -1) return two(b, c);
    if (a < 0) return two(b, c) - beyond_all(-a, b, c);
    if (b <= -1) return two(a, c);
    if (b < 0) return two(a, c) - beyond_all(a, -b, c);
    if (c <= -1) return two(a, b);
    if (c < 0) return two(a, b) - beyond_all(a, b, -c);
    return beyond(a, b, c);
}

}  // namespace

double ball_in_box(double radius, glm::dvec3 lower, glm::dvec3 upper) {
    const glm::dvec3 near = lower / radius, far = upper / radius;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const auto at = [&](int axis) { return (corner >> axis & 1) != 0 ? far[axis] : near[axis]; };
        const double part = beyond_all(at(0), at(1), at(2));
        const bool odd = ((corner ^ corner >> 1 ^ corner >> 2) & 1) != 0;
        sum += odd ? -part : part;
    }
    return std::clamp(sum, 0.0, 4 * pi / 3) * radius * radius * radius;
}

}  // namespace scree
