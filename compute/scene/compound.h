// The mass of several shapes on one body.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene.h"

namespace scree {

struct WholeMass {
    double mass = 0;        // kg
    glm::dvec3 centre{0};   // of mass, in the frame of the parts, m
    glm::dmat3 inertia{0};  // about it, along that frame's axes, kg m^2
};
// Of parts that may overlap: the mass of each counts. `density` is that of the parts that have none of their own.
WholeMass mass_of(const Compound& compound, float density);

// Moves the parts so that their centre of mass is the origin and their principal axes of inertia its axes, and says where that
// frame was: its origin (m) and its turn in the frame before. What lies so already, to rounding, stays.
struct Recentred {
    glm::dvec3 centre{0};
    glm::dquat axes{1, 0, 0, 0};
};
Recentred bring_to_centre(Compound& compound, float density);

}  // namespace scree
