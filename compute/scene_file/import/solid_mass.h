// Masses, centres and inertia tensors of solids in double precision, in frames of their own.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "compute/shapes.h"

namespace scree::imports {

using glm::dmat3;
using glm::dquat;
using glm::dvec3;

struct Placed {  // a frame in another
    dvec3 position{0};
    dquat turn{1, 0, 0, 0};
    dvec3 operator*(const dvec3& point) const { return position + turn * point; }
    Placed operator*(const Placed& inner) const { return {*this * inner.position, glm::normalize(turn * inner.turn)}; }
};
Placed inverse(const Placed& frame);
dmat3 diagonal(const dvec3& values);

struct SolidMass {
    double mass = 0;   // kg
    dvec3 centre{0};   // m
    dmat3 inertia{0};  // kg m^2, about the centre, axes of the frame
};
SolidMass sum_of(const SolidMass& a, const SolidMass& b);
SolidMass placed_mass(const SolidMass& mass, const Placed& frame);
SolidMass scaled_mass(SolidMass mass, double factor);
// Of a solid that a linear map and a shift stretch and shear, of the same density.
SolidMass stretched_mass(const SolidMass& mass, const dmat3& linear, const dvec3& offset);

// Of density 1, in the frame of a shape (scree's: cylinders along y). Of planes 0; not of hulls.
SolidMass primitive_mass(const SimpleShape& shape);
SolidMass hull_mass(const std::vector<vec3>& corners);  // throws HullError
// Of what triangles enclose (Eberly, Polyhedral mass properties); negative if they face inwards.
SolidMass enclosed_mass(const std::vector<vec3>& vertices, const std::vector<glm::uvec3>& triangles);

}  // namespace scree::imports
