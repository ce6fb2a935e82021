// Free rotation against Euler's equations: angular momentum, energy and direction, from balls to needles, slow and fast.
#include "shaders/physics/body/motion.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace scree::physics;
using glm::dvec3;
using glm::dvec4;

namespace {

constexpr float substep = 1 / 480.0f;

dvec3 rotated(const dvec4& q, const dvec3& v) {
    const dvec3 u(q);
    const dvec3 t = 2.0 / glm::dot(q, q) * glm::cross(u, v);
    return v + q.w * t + glm::cross(u, t);
}
dvec3 rotated_back(const dvec4& q, const dvec3& v) {
    return rotated({-q.x, -q.y, -q.z, q.w}, v);
}

// Euler's equations in double precision by the fourth-order Runge-Kutta method.
struct RigidBody {
    dvec3 moments;
    dvec4 orientation;
    dvec3 spin;  // in the body's axes, rad/s

    struct Rates {
        dvec4 orientation;
        dvec3 spin;
    };
    Rates rates(const RigidBody& at) const {
        const dvec3 u(at.orientation), w = at.spin;
        return {dvec4(0.5 * (at.orientation.w * w + glm::cross(u, w)), -0.5 * glm::dot(u, w)),
                glm::cross(moments * w, w) / moments};
    }
    void advance(double time, int steps) {
        const double h = time / steps;
        const auto moved = [&](const Rates& by, double f) {
            return RigidBody{moments, orientation + f * by.orientation, spin + f * by.spin};
        };
        for (int n = 0; n < steps; ++n) {
            const Rates a = rates(*this), b = rates(moved(a, h / 2)), c = rates(moved(b, h / 2)), d = rates(moved(c, h));
            orientation += h / 6 * (a.orientation + 2.0 * b.orientation + 2.0 * c.orientation + d.orientation);
            spin += h / 6 * (a.spin + 2.0 * b.spin + 2.0 * c.spin + d.spin);
        }
    }
};

struct Free {
    BodyProperties body{};
    Pose pose{};
    Velocity velocity{};

    Free(dvec3 moments, dvec4 orientation, dvec3 spin) {
        body.motion = MOTION_DYNAMIC;
        body.inverse_inertia = vec3(1.0 / moments);
        pose.orientation = unit_quaternion(vec4(orientation));
        velocity.angular = vec3(rotated(dvec4(pose.orientation), spin));
    }
    dvec3 moments() const { return 1.0 / dvec3(body.inverse_inertia); }
    dvec3 spin() const { return rotated_back(dvec4(pose.orientation), dvec3(velocity.angular)); }
    dvec3 momentum() const { return rotated(dvec4(pose.orientation), moments() * spin()); }
    double energy() const { return 0.5 * glm::dot(spin(), moments() * spin()); }
    void move(int substeps) {
        for (int n = 0; n < substeps; ++n) {
            const RigidState after = integrate(pose, velocity, body, substep);
            pose = after.pose;
            velocity = after.velocity;
        }
    }
};

// Axes of rotation in the body: its own, one near the first, and others all over the sphere.
std::vector<dvec3> axes_of_spin() {
    std::vector<dvec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, glm::normalize(dvec3(1, 1e-3, 1e-3))};
    for (int i = 0; i < 8; ++i) {
        const double rise = 1 - (2 * i + 1) / 8.0, level = std::sqrt(1 - rise * rise);
        axes.emplace_back(level * std::cos(2.4 * i), rise, level * std::sin(2.4 * i));
    }
    return axes;
}
dvec4 orientation_of(int trial) {
    if (trial % 2 == 0) return {0, 0, 0, 1};
    return glm::normalize(dvec4(std::sin(1.7 * trial), std::cos(2.9 * trial), std::sin(4.1 * trial), 0.6));
}

const std::vector<dvec3> shapes{{1, 1, 1.1},      {1, 2, 2.5},  {1, 1, 2},    {0.1, 1, 1},  {1, 1e-2, 1},
                                {1e-3, 1, 1.001}, {1, 1, 1e-4}, {1e-5, 1, 1}, {1e-6, 1, 1}, {1, 1e-6, 1.0000005}};

}  // namespace

TEST_CASE("free bodies, from balls to needles, keep their angular momentum and their energy at any speed") {
    for (const dvec3& moments : shapes) {
        const double thick = std::max({moments.x, moments.y, moments.z}), thin = std::min({moments.x, moments.y, moments.z});
        for (const double speed : {1.0, 30.0, 300.0}) {
            // The splitting's own error, of second order; and rounding of the angular velocity about the thick axes, which has
            // this much of the energy of a needle that spins about its own.
            const double turn = speed * static_cast<double>(substep);
            const double most_energy = 2e-4 + 7e-3 * turn * turn + 4e-9 * thick / thin;
            int trial = 0;
            for (const dvec3& axis : axes_of_spin()) {
                Free body(moments, orientation_of(trial++), speed * axis);
                const dvec3 momentum = body.momentum();
                const double energy = body.energy();
                double lost = 0, gained = 0;
                for (int n = 0; n < 120; ++n) {  // 30 s
                    body.move(120);
                    lost = std::max(lost, glm::length(body.momentum() - momentum) / (thick * speed));
                    gained = std::max(gained, std::abs(body.energy() / energy - 1));
                }
                INFO("moments " << moments.x << " : " << moments.y << " : " << moments.z << ", " << speed << " rad/s about "
                                << axis.x << ", " << axis.y << ", " << axis.z);
                CHECK(lost < 2e-4);
                CHECK(gained < most_energy);
            }
        }
    }
}

TEST_CASE("rods and plates, however thin, point where Euler's equations say") {
    for (const dvec3& moments : {dvec3(1, 1, 2), dvec3(0.1, 1, 1), dvec3(1, 1e-3, 1), dvec3(1, 1, 1e-6)}) {
        const dvec3 axis = moments.x != moments.y ? (moments.x == moments.z ? dvec3(0, 1, 0) : dvec3(1, 0, 0)) : dvec3(0, 0, 1);
        for (const double speed : {1.0, 30.0, 100.0}) {
            int trial = 0;
            for (const dvec3& about : axes_of_spin()) {
                Free body(moments, orientation_of(trial++), speed * about);
                // A needle's momentum about its own axis is less than the rounding of that about the others.
                if (glm::length(glm::cross(axis, about)) < 0.1) continue;
                RigidBody exact{body.moments(), dvec4(body.pose.orientation), body.spin()};
                double apart = 0;
                for (int n = 0; n < 20; ++n) {  // 2 s
                    body.move(48);
                    exact.advance(48 * static_cast<double>(substep), 48 * 40);
                    const dvec3 now = rotated(dvec4(body.pose.orientation), axis), then = rotated(exact.orientation, axis);
                    apart = std::max(apart, std::acos(std::min(1.0, glm::dot(now, then) / glm::length(now) / glm::length(then))));
                }
                INFO("moments " << moments.x << " : " << moments.y << " : " << moments.z << ", " << speed << " rad/s about "
                                << about.x << ", " << about.y << ", " << about.z);
                CHECK(apart < 5e-4);
            }
        }
    }
}
