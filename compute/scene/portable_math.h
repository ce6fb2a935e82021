// Functions of mathematics with the same bits on every machine, from operations that IEEE 754 rounds exactly. C libraries differ
// in the last bit of theirs, and compilers in what they compute ahead; scenes that are made with them would begin otherwise
// elsewhere. Errors are at most 5 units in the last place of a double, of pow() 30. Floats are taken to double and rounded once.
#pragma once

#include <concepts>
#include <glm/gtc/quaternion.hpp>

namespace scree::portable {

// Angles in radians. Of more than 1e6 radians the error grows with the angle.
double sin(double angle);
double cos(double angle);
double tan(double angle);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);

double exp(double x);
double log(double x);
double pow(double base, double exponent);  // of a positive base
double cbrt(double x);
// Not scaled: squares above a double's range, or below it, are infinite or zero.
double hypot(double x, double y);

template <std::same_as<float> Float>
Float sin(Float angle) {
    return static_cast<Float>(sin(static_cast<double>(angle)));
}
template <std::same_as<float> Float>
Float cos(Float angle) {
    return static_cast<Float>(cos(static_cast<double>(angle)));
}
template <std::same_as<float> Float>
Float tan(Float angle) {
    return static_cast<Float>(tan(static_cast<double>(angle)));
}
template <std::same_as<float> Float>
Float atan(Float x) {
    return static_cast<Float>(atan(static_cast<double>(x)));
}
template <std::same_as<float> Float>
Float atan2(Float y, Float x) {
    return static_cast<Float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}
template <std::same_as<float> Float>
Float pow(Float base, Float exponent) {
    return static_cast<Float>(pow(static_cast<double>(base), static_cast<double>(exponent)));
}
template <std::same_as<float> Float>
Float cbrt(Float x) {
    return static_cast<Float>(cbrt(static_cast<double>(x)));
}
template <std::same_as<float> Float>
Float hypot(Float x, Float y) {
    return static_cast<Float>(hypot(static_cast<double>(x), static_cast<double>(y)));
}

// The rotation by `angle` about a unit axis.
inline glm::dquat turn_about(glm::dvec3 axis, double angle) {
    const double sine = sin(angle / 2);
    return glm::dquat(cos(angle / 2), axis.x * sine, axis.y * sine, axis.z * sine);
}

}  // namespace scree::portable
