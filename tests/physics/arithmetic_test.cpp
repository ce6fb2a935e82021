// The step's arithmetic against double precision: reciprocals, square roots, directions, rotations.
#include "shaders/physics/base/arithmetic.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <vector>

#include "shaders/physics/body/motion.h"
#include "tests/world/heaps.h"

using namespace scree;
using namespace scree::physics;

namespace {

constexpr double promised = 1.5e-7;

float from_bits(std::uint32_t exponent, std::uint32_t mantissa) {
    return glm::uintBitsToFloat((exponent << 23) | mantissa);
}
double off(double measured, double expected) {
    return std::abs(measured - expected) / std::abs(expected);
}
double reciprocal_off(float x) {
    return off(reciprocal(x), 1.0 / x);
}
double inverse_square_root_off(float x) {
    return off(inverse_square_root(x), 1.0 / std::sqrt(static_cast<double>(x)));
}

// Directions: axes, diagonals, neighbourhoods of the poles, random ones.
std::vector<vec3> directions() {
    std::vector<glm::dvec3> found;
    for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
            for (int z = -1; z <= 1; ++z) {
                if (x || y || z) found.emplace_back(x, y, z);
            }
        }
    }
    for (const double near : {1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-20}) {
        for (const double z : {-1.0, 1.0}) {
            for (const double side : {-1.0, 1.0}) {
                found.emplace_back(side * near, 0, z);
                found.emplace_back(0, side * near, z);
                found.emplace_back(near, side * near, z);
                found.emplace_back(1, side * near, z * near);
            }
        }
    }
    tests::Noise noise(11);
    while (found.size() < 20000) {
        const vec3 v = noise.vector();
        if (glm::length(v) > 0.1f) found.emplace_back(v);
    }
    std::vector<vec3> unit;
    for (const glm::dvec3& v : found) unit.emplace_back(glm::normalize(v));
    return unit;
}

std::vector<vec4> turns() {
    std::vector<vec4> found = {{0, 0, 0, 1}, {0, 0, 0, -1}, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0.5f, 0.5f, 0.5f, 0.5f}};
    tests::Noise noise(12);
    while (found.size() < 2000) {
        const glm::dvec4 q{noise(), noise(), noise(), noise()};
        if (glm::length(q) > 0.1) found.emplace_back(glm::normalize(q));
    }
    return found;
}

double apart(vec3 a, glm::dvec3 b) {
    return glm::length(glm::dvec3(a) - b);
}

}  // namespace

TEST_CASE("reciprocal and inverse square root are as near as they say, over their whole range") {
    // The Newton seed scales with the exponent, so errors depend on the mantissa alone (for the root also on the
    // exponent's parity). Tests every seventh mantissa; exponents, with fewer mantissas, below.
    double worst = 0, worst_root = 0;
    for (std::uint32_t mantissa = 0; mantissa < 1u << 23; mantissa += 7) {
        worst = std::max(worst, reciprocal_off(from_bits(127, mantissa)));
        worst_root = std::max(
            {worst_root, inverse_square_root_off(from_bits(127, mantissa)), inverse_square_root_off(from_bits(128, mantissa))});
    }
    for (std::uint32_t exponent = 127 - 125; exponent < 127 + 125; ++exponent) {
        for (std::uint32_t mantissa = 1; mantissa < 1u << 23; mantissa += 12345) {
            const float x = from_bits(exponent, mantissa);
            worst = std::max({worst, reciprocal_off(x), reciprocal_off(-x)});
            worst_root = std::max(worst_root, inverse_square_root_off(x));
        }
    }
    INFO("reciprocal " << worst << ", inverse square root " << worst_root);
    CHECK(worst < promised);
    CHECK(worst_root < promised);
}

TEST_CASE("square root: exact at 0, near elsewhere, and without a sign of its own") {
    REQUIRE(glm::floatBitsToUint(square_root(0.0f)) == 0);
    REQUIRE(square_root(-4.0f) == 0);
    REQUIRE(square_root(1e-31f) == 0);
    for (float x = 1.1e-30f; x < 1e30f; x *= 1.37f)
        REQUIRE(off(square_root(x), std::sqrt(static_cast<double>(x))) < 2 * promised);
}

TEST_CASE("a tangent is a unit vector across the normal, in every direction") {
    for (const vec3 n : directions()) {
        CAPTURE(n.x, n.y, n.z);
        const glm::dvec3 t(tangent(n)), second(cross3(n, tangent(n)));
        REQUIRE(std::abs(glm::length(t) - 1) < 5e-7);
        REQUIRE(std::abs(glm::dot(t, glm::dvec3(n))) < 5e-7);
        REQUIRE(std::abs(glm::length(second) - 1) < 1e-6);
        REQUIRE(std::abs(glm::dot(second, t)) < 5e-7);
    }
}

TEST_CASE("rotate, its inverse, the axes and the upright turn alike, as glm does in double precision") {
    const std::vector<vec3> vectors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3f, -0.5f, 0.8f}};
    const std::vector<vec4> all = turns();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const vec4 q = all[i], p = all[(i * 7 + 3) % all.size()];
        const glm::dquat exact(q.w, q.x, q.y, q.z), exact_p(p.w, p.x, p.y, p.z);
        const Axes axes = axes_of(q);
        CAPTURE(q.x, q.y, q.z, q.w);
        REQUIRE(apart(axes.x, exact * glm::dvec3(1, 0, 0)) < 1e-6);
        REQUIRE(apart(axes.y, exact * glm::dvec3(0, 1, 0)) < 1e-6);
        REQUIRE(apart(axes.z, exact * glm::dvec3(0, 0, 1)) < 1e-6);
        REQUIRE(apart(upright(q), exact * glm::dvec3(0, 1, 0)) < 1e-6);
        for (const vec3 v : vectors) {
            REQUIRE(apart(rotate(q, v), exact * glm::dvec3(v)) < 1e-6);
            REQUIRE(apart(rotate_back(q, rotate(q, v)), v) < 1e-6);
            REQUIRE(apart(rotate(compose(q, p), v), exact * (exact_p * glm::dvec3(v))) < 2e-6);
        }
        const vec4 longer = unit_quaternion(q * 3.7f);
        REQUIRE(std::abs(glm::length(glm::dvec4(longer)) - 1) < 3e-7);
        REQUIRE(glm::length(glm::dvec4(longer - q)) < 5e-7);
    }
}

TEST_CASE("a unit vector of nothing is the other one, and keeps its direction else") {
    const vec3 other(0, 0, 1);
    for (const vec3 small : {vec3(0), vec3(1e-13f, 0, 0), vec3(0, -1e-20f, 1e-30f)}) REQUIRE(unit3(small, other) == other);
    for (const vec3 n : directions()) {
        for (const float length : {1e-11f, 1e-3f, 1.0f, 7e5f, 1e15f})
            REQUIRE(apart(unit3(n * length, other), glm::normalize(glm::dvec3(n))) < 5e-7);
    }
}

TEST_CASE("what is shortened keeps its direction, and what is short enough its bits") {
    for (const vec3 n : directions()) {
        const vec3 cut = shortened(n * 1000.0f, 40.0f);
        REQUIRE(std::abs(glm::length(glm::dvec3(cut)) - 40) < 40 * 5e-7);
        REQUIRE(glm::length(glm::cross(glm::normalize(glm::dvec3(cut)), glm::dvec3(n))) < 5e-7);
        REQUIRE(shortened(n * 39.99f, 40.0f) == n * 39.99f);
    }
    REQUIRE(shortened(vec3(0), 40.0f) == vec3(0));
}

TEST_CASE("whatever pushed a body, its velocity is finite and within what a step can handle") {
    Parameters parameters{};
    parameters.max_speed = 400;
    parameters.max_spin = 300;
    const float infinite = std::numeric_limits<float>::infinity(), greatest = std::numeric_limits<float>::max();
    for (const float much : {500.0f, 1e10f, greatest, infinite, -infinite}) {
        for (const vec3 v : {vec3(much, 0, 0), vec3(0, much, -much), vec3(much)}) {
            Velocity velocity{};
            velocity.linear = v;
            velocity.angular = -v;
            velocity = clamp_velocity(velocity, parameters);
            CAPTURE(v.x, v.y, v.z);
            REQUIRE(std::abs(glm::length(glm::dvec3(velocity.linear)) - 400) < 1e-3);
            REQUIRE(std::abs(glm::length(glm::dvec3(velocity.angular)) - 300) < 1e-3);
            REQUIRE(velocity.linear.x * v.x >= 0);
            REQUIRE(velocity.angular.y * v.y <= 0);
        }
    }
    Velocity slow{};
    slow.linear = vec3(1, -2, 3);
    slow.angular = vec3(-0.0f, 5, 0);
    REQUIRE(clamp_velocity(slow, parameters).linear == slow.linear);
    REQUIRE(clamp_velocity(slow, parameters).angular == slow.angular);
}

TEST_CASE("comparisons choose as they say where min and max of processors differ") {
    REQUIRE(glm::floatBitsToUint(positive(-0.0f)) == 0);
    REQUIRE(positive(std::nanf("")) == 0);
    REQUIRE(clamped(-3, -1, 2) == -1);
    REQUIRE(clamped(3, -1, 2) == 2);
    REQUIRE(clamped(0.5f, -1, 2) == 0.5f);
    REQUIRE(flush_tiny(vec3(1e-19f, -1e-19f, 1e-17f)) == vec3(0, 0, 1e-17f));
}
