// Portable mathematics: near the C library's in long double, exact where the value is known, and the same bits on every machine.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <random>

#include "compute/scene/portable_math.h"

namespace {

namespace portable = scree::portable;

double units(double value, long double exact) {
    const double size = std::abs(static_cast<double>(exact));
    if (size == 0) return value == 0 ? 0 : 1e9;
    return static_cast<double>(std::abs(static_cast<long double>(value) - exact)) /
           (std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
}

}  // namespace

TEST_CASE("portable functions are within 5 units in the last place of exact ones, and powers within 30") {
    std::mt19937_64 random(1);
    double most = 0, most_of_powers = 0;
    for (int k = 0; k < 200'000; ++k) {
        const auto between = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
        };
        const double angle = between(-1, 1) * (k % 2 == 0 ? 7 : 1e5), part = between(-1, 1), x = between(-9, 9),
                     y = between(-9, 9);
        const double exponent = between(-30, 30), positive = std::exp2(exponent);
        const long double a = angle, p = part, lx = x, ly = y, e = exponent, q = positive;
        for (const double off : {units(portable::sin(angle), std::sin(a)), units(portable::cos(angle), std::cos(a)),
                                 units(portable::tan(angle), std::tan(a)), units(portable::asin(part), std::asin(p)),
                                 units(portable::acos(part), std::acos(p)), units(portable::atan(x), std::atan(lx)),
                                 units(portable::atan2(y, x), std::atan2(ly, lx)), units(portable::exp(exponent), std::exp(e)),
                                 units(portable::log(positive), std::log(q)), units(portable::cbrt(positive), std::cbrt(q)),
                                 units(portable::hypot(x, y), std::hypot(lx, ly))})
            most = std::max(most, off);
        most_of_powers = std::max(most_of_powers, units(portable::pow(positive, part), std::pow(q, p)));
    }
    CHECK(most <= 5.5);  // where long double is double: half of one is the reference's
    CHECK(most_of_powers <= 30.5);
}

TEST_CASE("portable functions are exact where they must be") {
    CHECK(portable::sin(0.0) == 0);
    CHECK(portable::cos(0.0) == 1);
    CHECK(portable::exp(0.0) == 1);
    CHECK(portable::log(1.0) == 0);
    CHECK(portable::acos(1.0) == 0);
    CHECK(portable::atan2(0.0, 0.0) == 0);
    CHECK(portable::atan2(0.0, -1.0) == std::numbers::pi);
    CHECK(portable::atan2(-0.0, -1.0) == -std::numbers::pi);
    CHECK(portable::atan2(1.0, 0.0) == std::numbers::pi / 2);
    for (int k = -1000; k <= 1000; ++k) CHECK(portable::cbrt(static_cast<double>(k) * k * k) == k);
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(portable::sin(infinity)));
    CHECK(std::isnan(portable::cos(nan)));
    CHECK(std::isnan(portable::acos(1.5)));
    CHECK(portable::exp(1000.0) == infinity);
    CHECK(portable::exp(-1000.0) == 0);
    CHECK(portable::log(0.0) == -infinity);
    CHECK(std::isnan(portable::log(-1.0)));
    CHECK(std::abs(portable::sin(1e300)) <= 1);
    const glm::dquat quarter = portable::turn_about({0, 1, 0}, std::numbers::pi / 2);
    CHECK(glm::length(quarter * glm::dvec3(0, 0, 1) - glm::dvec3(1, 0, 0)) < 1e-15);
}

// The number that this machine, like any other, comes to.
TEST_CASE("portable functions have the same bits on every machine") {
    std::uint64_t bits = 0;
    const auto add = [&](double value) { bits = std::rotl(bits, 7) * 0x9E3779B97F4A7C15u ^ std::bit_cast<std::uint64_t>(value); };
    for (int k = 1; k < 5000; ++k) {
        const double x = 0.0137 * k, part = x / (1 + x);
        for (const double value : {portable::sin(x), portable::cos(-x), portable::tan(x), portable::asin(part),
                                   portable::acos(-part), portable::atan(x), portable::atan2(-part, x), portable::exp(-x),
                                   portable::log(x), portable::pow(x, part), portable::cbrt(x), portable::hypot(x, part)})
            add(value);
    }
    CHECK(bits == 0xf4e00a63bb9aeaf2u);
}
