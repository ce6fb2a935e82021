// Coulomb friction of a flat face under uniform pressure, integrated over the face (Farkas, Bartels, Unger, Wolf, Frictional
// Coupling between Sliding and Spinning Motion, Phys. Rev. Lett. 90, 248302, 2003): what slides and spins comes to rest.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace scree::demos {

// Points of equal area on a face, m, and the body's moment of inertia per mass about the face's normal, m^2.
struct Face {
    std::vector<glm::dvec2> points;
    double inertia = 0;
};
Face rectangle(double half_x, double half_z);
Face disc(double radius);

// Distance (m) and time (s) until slip (from `speed`, m/s) and spin (from `spin`, rad/s) have ended.
struct Stop {
    double distance = 0, time = 0;
};
Stop stop_of(const Face& face, double friction, double speed, double spin);

}  // namespace scree::demos
