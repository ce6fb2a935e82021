// Argument reduction by constants in three parts (Cody and Waite, Software Manual for the Elementary Functions, 1980), then
// Taylor series to the last bit of a double.
#include "compute/scene/portable_math.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace scree::portable {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// x less the nearest multiple k of a constant, whose first two parts have 33 bits each: their products with k are exact.
struct Reduced {
    double rest;
    int multiple;  // for sines, modulo 4
};
Reduced reduce(double x, double inverse, double first, double second, double third) {
    const double k = std::floor(x * inverse + 0.5);
    return {((x - k * first) - k * second) - k * third, static_cast<int>(k - 4 * std::floor(k / 4))};
}
Reduced quarter_turns(double angle) {
    if (std::abs(angle) > 1e6) angle = std::fmod(angle, 2 * std::numbers::pi);
    return reduce(angle, 2 / std::numbers::pi, 0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69);
}

// Of |x| <= pi / 4.
double sine_near_zero(double x) {
    const double z = x * x;
    double sum = 0;
    for (int n = 18; n >= 2; n -= 2) sum = -z / (n * (n + 1)) * (1 + sum);
    return x + x * sum;
}
double cosine_near_zero(double x) {
    const double z = x * x, half = 0.5 * z;
    double sum = 0;
    for (int n = 19; n >= 3; n -= 2) sum = -z / (n * (n + 1)) * (1 + sum);
    const double near = 1 - half;  // what its rounding loses comes back
    return near + (((1 - near) - half) - half * sum);
}

// Of |x| <= 0.2.
double arc_near_zero(double x) {
    const double z = x * x;
    double sum = 0;
    for (int n = 23; n >= 3; n -= 2) sum = -z * (1.0 / n + sum);
    return x + x * sum;
}

}  // namespace

double sin(double angle) {
    if (!std::isfinite(angle)) return nan;
    const auto [x, quarters] = quarter_turns(angle);
    const double value = quarters % 2 == 1 ? cosine_near_zero(x) : sine_near_zero(x);
    return quarters >= 2 ? -value : value;
}

double cos(double angle) {
    if (!std::isfinite(angle)) return nan;
    const auto [x, quarters] = quarter_turns(angle);
    const double value = quarters % 2 == 1 ? sine_near_zero(x) : cosine_near_zero(x);
    return quarters == 1 || quarters == 2 ? -value : value;
}

double tan(double angle) {
    return sin(angle) / cos(angle);
}

double asin(double x) {
    return atan2(x, std::sqrt((1 - x) * (1 + x)));
}

double acos(double x) {
    return atan2(std::sqrt((1 - x) * (1 + x)), x);
}

// Half of an angle has the tangent t / (1 + sqrt(1 + t^2)).
double atan(double x) {
    if (std::isnan(x)) return nan;
    const double size = std::abs(x);
    double t = size > 1 ? 1 / size : size;
    for (int halving = 0; halving < 2; ++halving) t = t / (1 + std::sqrt(1 + t * t));
    const double small = 4 * arc_near_zero(t);
    return std::copysign(size > 1 ? std::numbers::pi / 2 - small : small, x);
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return nan;
    const double high = std::abs(y), along = std::abs(x);
    double angle = 0;
    if (high == infinity && along == infinity)
        angle = std::numbers::pi / 4;
    else if (high != 0 || along != 0)
        angle = high > along ? std::numbers::pi / 2 - atan(along / high) : atan(high / along);
    return std::copysign(std::signbit(x) ? std::numbers::pi - angle : angle, y);
}

double exp(double x) {
    if (std::isnan(x)) return nan;
    if (x > 710) return infinity;
    if (x < -746) return 0;
    const double k = std::floor(x / std::numbers::ln2 + 0.5);
    const double rest = ((x - k * 0x1.62e42fefp-1) - k * 0x1.473de6afp-34) - k * 0x1.3c7673007e5edp-69;
    double sum = 0;
    for (int n = 16; n >= 2; --n) sum = rest / n * (1 + sum);
    return std::ldexp(1 + (rest + rest * sum), static_cast<int>(k));
}

double log(double x) {
    if (!(x > 0)) return x == 0 ? -infinity : nan;
    if (x == infinity) return infinity;
    int exponent = 0;
    double part = std::frexp(x, &exponent);
    if (part < std::numbers::sqrt2 / 2) {
        part *= 2;
        --exponent;
    }
    const double s = (part - 1) / (part + 1), z = s * s;
    double sum = 0;
    for (int n = 25; n >= 3; n -= 2) sum = z * (1.0 / n + sum);
    return exponent * 0x1.62e42fefp-1 + (2 * (s + s * sum) + exponent * (0x1.473de6afp-34 + 0x1.3c7673007e5edp-69));
}

double pow(double base, double exponent) {
    return base == 0 && exponent > 0 ? 0 : exp(exponent * log(base));
}

double cbrt(double x) {
    if (x == 0 || !std::isfinite(x)) return x;
    int exponent = 0;
    double part = std::frexp(std::abs(x), &exponent);
    while (exponent % 3 != 0) {
        part *= 0.5;
        ++exponent;
    }
    double root = 0.4 + 0.6 * part;  // of 1/8 to 1
    for (int round = 0; round < 6; ++round) root -= (root * root * root - part) / (3 * root * root);
    return std::copysign(std::ldexp(root, exponent / 3), x);
}

double hypot(double x, double y) {
    return std::sqrt(x * x + y * y);
}

}  // namespace scree::portable
