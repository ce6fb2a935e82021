// Inclines with one body each, for scenes about friction and rolling.
#pragma once

#include "compute/scene.h"

namespace scree::demos {

constexpr double earth_gravity = 9.81;  // m/s^2

struct Incline {
    float angle;              // rad
    float half_length;        // m
    float half_width = 0.5f;  // m

    vec3 down() const;      // unit vector down the slope, towards +x
    vec3 out() const;       // outward unit normal
    double along() const;   // gravity along the slope, m/s^2
    double across() const;  // gravity into the slope, m/s^2
};

// Adds an incline centred at z, and `body` on it with its centre `height` (m) above the surface and `clear` (m) from
// the upper end. Both get the friction coefficient. Returns the body's index.
std::size_t add_lane(Scene& scene, const Incline& incline, float z, Body body, float height, float friction, float clear = 0.8f);

// Fraction of gravity that accelerates a body rolling without slipping, 1 / (1 + I / (m R^2)), where I is about the
// axis of a sphere or capsule.
double going_part(const Body& body);
float radius_of(const Body& body);  // radius of a sphere or capsule, m

}  // namespace scree::demos
