// Mass properties of compounds.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene.h"

namespace scree {

struct WholeMass {
    double mass = 0;        // kg
    glm::dvec3 centre{0};   // centre of mass, in the frame of the parts, m
    glm::dmat3 inertia{0};  // about the centre of mass, axes of that frame, kg m^2
};
// Masses of overlapping parts add up. `density` (kg/m^3): for parts without a density of their own.
WholeMass mass_of(const Compound& compound, float density);
// Of a checked body, m^3; volumes of overlapping parts add up, and what is flat or has no shape has none.
double solid_volume_of(const Body& body);

// Moves the parts so that their centre of mass is the origin and their principal axes of inertia are the axes. Returns
// the new frame in the old one: origin (m) and rotation. Parts already so, to rounding, stay bit-identical.
struct Recentred {
    glm::dvec3 centre{0};
    glm::dquat axes{1, 0, 0, 0};
};
Recentred bring_to_centre(Compound& compound, float density);

// Into a frame about `centre`; `back`: from the axes of the old frame to those of the new one.
void move_skins(Compound& compound, const glm::dvec3& centre, const glm::dquat& back);

}  // namespace scree
