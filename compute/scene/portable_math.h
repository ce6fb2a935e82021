// Functions of mathematics with the same bits on every machine, from operations that IEEE 754 rounds exactly. C libraries differ
// in the last bit of theirs, and compilers in what they compute ahead; scenes that are made with them would begin otherwise
// elsewhere. Errors are at most 5 units in the last place of a double, of pow() 30. Floats are taken to double and rounded once.
#pragma once

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

inline float sin(float angle) {
    return static_cast<float>(sin(static_cast<double>(angle)));
}
inline float cos(float angle) {
    return static_cast<float>(cos(static_cast<double>(angle)));
}
inline float tan(float angle) {
    return static_cast<float>(tan(static_cast<double>(angle)));
}
inline float atan(float x) {
    return static_cast<float>(atan(static_cast<double>(x)));
}
inline float atan2(float y, float x) {
    return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline float pow(float base, float exponent) {
    return static_cast<float>(pow(static_cast<double>(base), static_cast<double>(exponent)));
}
inline float cbrt(float x) {
    return static_cast<float>(cbrt(static_cast<double>(x)));
}
inline float hypot(float x, float y) {
    return static_cast<float>(hypot(static_cast<double>(x), static_cast<double>(y)));
}

// The rotation by `angle` about a unit axis.
inline glm::dquat turn_about(glm::dvec3 axis, double angle) {
    const double sine = sin(angle / 2);
    return glm::dquat(cos(angle / 2), axis.x * sine, axis.y * sine, axis.z * sine);
}

}  // namespace scree::portable
