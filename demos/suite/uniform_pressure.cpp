// Friction under uniform pressure: quadrature over the face, semi-implicit Euler over time.
#include "demos/suite/uniform_pressure.h"

#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/incline.h"

namespace scree::demos {

namespace {

constexpr int across = 24;  // points

Face face_of(double half_x, double half_z, bool round) {
    Face face;
    for (int i = 0; i < across; ++i) {
        for (int k = 0; k < across; ++k) {
            const glm::dvec2 at((2 * i + 1.0) / across - 1, (2 * k + 1.0) / across - 1);
            if (!round || glm::dot(at, at) < 1) face.points.emplace_back(at.x * half_x, at.y * half_z);
        }
    }
    face.inertia = round ? half_x * half_x / 2 : (half_x * half_x + half_z * half_z) / 3;
    return face;
}

}  // namespace

Face rectangle(double half_x, double half_z) {
    return face_of(half_x, half_z, false);
}

Face disc(double radius) {
    return face_of(radius, radius, true);
}

Stop stop_of(const Face& face, double friction, double speed, double spin) {
    const double step = 1e-3;
    Stop stop;
    for (double turn = 0; speed > 1e-3 || spin > 2e-3; stop.time += step) {
        double force = 0, moment = 0;
        for (const glm::dvec2 point : face.points) {
            const double x = portable::cos(turn) * point.x - portable::sin(turn) * point.y;
            const double z = portable::sin(turn) * point.x + portable::cos(turn) * point.y;
            const double along = speed - spin * z, aside = spin * x, slip = portable::hypot(along, aside) + 1e-6;
            force += along / slip;
            moment += (x * aside - z * along) / slip;
        }
        const double rate = step * friction * earth_gravity / static_cast<double>(face.points.size());
        speed -= std::min(speed, rate * force);
        spin -= std::min(spin, rate * moment / face.inertia);
        turn += spin * step;
        stop.distance += speed * step;
    }
    return stop;
}

}  // namespace scree::demos
