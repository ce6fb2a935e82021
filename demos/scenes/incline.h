// An incline and a body on it: the lanes of every scene about sliding, sticking and rolling down.
#pragma once

#include "compute/scene.h"

namespace scree::demos {

constexpr double earth_gravity = 9.81;  // m/s^2

struct Incline {
    float angle;              // rad
    float half_length;        // m
    float half_width = 0.5f;  // m

    vec3 down() const;      // unit vector along it, toward +x
    vec3 out() const;       // unit vector out of it
    double along() const;   // of gravity, m/s^2
    double across() const;  // m/s^2
};

// Adds an incline whose middle is at z, and `body` touching it, its centre `height` above the surface, `clear` m from the upper
// end. Both get the friction. Returns the body's index.
std::size_t add_lane(Scene& scene, const Incline& incline, float z, Body body, float height, float friction, float clear = 0.8f);

// Of gravity on a body that rolls without slipping, the part that makes it go and not turn, 1 / (1 + I / (m R^2)); I is about the
// axis of a sphere or of a capsule.
double going_part(const Body& body);
float radius_of(const Body& body);  // of a sphere or a capsule, m

}  // namespace scree::demos
